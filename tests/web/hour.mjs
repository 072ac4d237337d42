// The page of an hour: how long it takes, how large it is, and how it opens and scrubs in Chromium. It prints the figures of
// docs/evidence.md; of them it judges the size alone, as times are those of the machine.
// usage: check.sh ZWANG SPECS FOLDER hour.mjs [LOG]   LOG: of a run that is there already
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';

const [, , zwang, specs, folder, browserPath, given] = process.argv;
const { chromium } = createRequire(new URL('../../web/package.json', import.meta.url))('playwright-core');
const seconds = 3600;
const took = (what, work) => {
  const begin = performance.now();
  const result = work();
  console.log(`${what}: ${((performance.now() - begin) / 1000).toFixed(1)} s`);
  return result;
};

/** The patrol without an end, for an hour of its own time. */
function runAnHour() {
  cpSync(specs, `${folder}/specs`, { recursive: true });
  const scenario = `${folder}/specs/scenarios/patrol_hour.yaml`;
  const text = readFileSync(`${specs}/scenarios/patrol.yaml`, 'utf8');
  writeFileSync(scenario, text.replace(/time_limit: .*/, `time_limit: ${seconds} s`));
  const run = took('run of an hour', () => spawnSync(zwang,
    ['run', scenario, '--cell', 'robot mecanum_base', '--log', `${folder}/hour`, '--quiet'], { encoding: 'utf8' }));
  assert.notEqual(run.status, 2, run.stderr);
  return `${folder}/hour`;
}

const page = `${folder}/hour.html`;
const log = given ?? runAnHour();
took('zwang report', () => execFileSync(zwang, ['report', log, '-o', page]));
console.log(`page: ${(statSync(page).size / 1e6).toFixed(2)} MB`);
assert.ok(statSync(page).size <= 5e6);

/** [ms] of the processors, in all processes of the browser: a frame's own cost, however busy the machine is. */
function processorTime(root) {
  const found = new Map();
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name))) {
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').replace(/^.*\) /s, '').split(' ').map(Number);
      found.set(Number(pid), { parent: fields[1], time: 10 * (fields[11] + fields[12]) });
    } catch { /* it has ended */ }
  }
  const isOurs = (pid) => pid === root || (found.has(pid) && isOurs(found.get(pid).parent));
  return [...found].reduce((sum, [pid, one]) => sum + (isOurs(pid) ? one.time : 0), 0);
}

// As on a computer without a graphics card: the processors draw what is in space, and put the page together.
const server = await chromium.launchServer({ executablePath: browserPath, args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader'] });
try {
  const browser = await chromium.connect(server.wsEndpoint());
  const tab = await browser.newPage({ viewport: { width: 1600, height: 900 } });
  // The first frame that has the verdict, and the one in which the page can be used: times since the page was asked for.
  await tab.addInitScript(() => {
    const look = () => {
      if (document.getElementById('verdict')) window.painted ??= performance.now();
      if (window.zwang) window.ready ??= performance.now();
      if (!window.ready) requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  });
  await tab.goto(`file://${page}`);
  for (let i = 0; i < 600 && !await tab.evaluate(() => window.ready); ++i) await tab.waitForTimeout(100);
  const [painted, ready] = await tab.evaluate(() => [window.painted, window.ready]);
  console.log(`first paint: ${(painted / 1000).toFixed(2)} s, usable: ${(ready / 1000).toFixed(2)} s`);
  await tab.waitForTimeout(3000);
  // One step a frame, through the whole hour: how long each takes in the page, and from frame to frame.
  const before = processorTime(server.process().pid);
  const frames = await tab.evaluate(() => new Promise((resolve) => {
    const { clock } = window.zwang;
    const [work, between] = [[], []];
    let last = performance.now();
    const step = (i) => {
      const now = performance.now();
      if (i > 0) between.push(now - last);
      last = now;
      if (i === 200) return resolve({ work, between });
      clock.show((clock.duration * i) / 200);
      work.push(performance.now() - now);
      requestAnimationFrame(() => step(i + 1));
    };
    requestAnimationFrame(() => step(0));
  }));
  const spent = processorTime(server.process().pid) - before;
  console.log(`processor time: ${(spent / frames.between.length).toFixed(1)} ms a frame`);
  const share = (list, s) => [...list].sort((a, b) => a - b)[Math.floor(s * (list.length - 1))].toFixed(1);
  for (const [what, list] of [['work of a scrub', frames.work], ['frame to frame', frames.between]])
    console.log(`${what}: ${share(list, 0.5)} ms in the middle, ${share(list, 0.95)} ms of 95 %, ${share(list, 1)} ms at most`);
} finally {
  await server.close();
}
