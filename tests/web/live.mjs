// The page of a run that goes on: what it asks for happens to the program, and the log replays.
// usage: node live.mjs ZWANG SPECS FOLDER CHROMIUM [look]: with `look` in space, too, and with screenshots
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tooFaint } from './contrast.mjs';

const [zwang, specs, folder, chromium, look] = process.argv.slice(2);
const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium: browsers } = require('playwright-core');

/** A run with its page; `arguments_` of `zwang run`. */
function begin(name, ...arguments_) {
  const process_ = spawn(zwang, ['run', ...arguments_, '--live', '--quiet', '--log', `${folder}/${name}`]);
  const ended = new Promise((resolve) => process_.on('exit', resolve));
  const address = new Promise((resolve, reject) => {
    let told = '';
    process_.stderr.on('data', (bytes) => {
      told += bytes;
      const found = told.match(/http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\//);
      if (found) resolve(found[0]);
    });
    process_.on('exit', () => reject(new Error(told)));
  });
  return { name, process: process_, ended, address };
}

// What is in space is drawn by the processor here, and keeps the page from everything else.
const inSpace = ['--disable-gpu', '--enable-unsafe-swiftshader'];
const browser = await browsers.launch({ executablePath: chromium, args: ['--no-sandbox', ...(look ? inSpace : ['--disable-3d-apis'])] });
const page = await browser.newPage({ viewport: { width: 1600, height: 900 }, reducedMotion: 'reduce' });
page.setDefaultTimeout(patience());
const complaints = [];
page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver|WebGL/.test(message.text())) complaints.push(message.text()); });
page.on('pageerror', (error) => complaints.push(error.message));
page.on('request', (request) => { if (!/^(blob:|http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/$)/.test(request.url())) complaints.push(`asks for ${request.url()}`); });

/** [ms] A busy machine takes its time: this only ends a test that waits in vain. */
function patience() { return 240000; }

/** Until the page says so. The page's policy forbids what `waitForFunction` does. */
async function until(what, value) {
  const end = Date.now() + patience();
  // A page that loads anew answers nothing meanwhile.
  while (!await page.evaluate(what, value).catch(() => false)) {
    assert.ok(Date.now() < end, `still not: ${what} of ${value}`);
    await page.waitForTimeout(50);
  }
}
/** A click that waits for no frame: without a graphics card a busy machine draws one in many seconds. */
const press = (button) => page.locator(button).dispatchEvent('click');
const records = () => page.evaluate(() => window.zwang.run.data.records);
/** Until nothing comes any more: what a run that stands has held back has arrived. */
async function settled() {
  let [before, same] = [-1, 0];
  while (same < 5) {
    const now = await records();
    same = now === before ? same + 1 : 0;
    before = now;
    await page.waitForTimeout(100);
  }
  return before;
}
/** One tick, and its record is there. */
async function tick(button = true) {
  const before = await settled();
  if (button) await press('#tick'); else await page.keyboard.press('.');
  await until((count) => window.zwang.run.data.records > count, before);
  return before;
}
const last = (column) => page.evaluate((name) => window.zwang.run.curve(name).at(-1), column);
const status = (word) => until((text) => document.getElementById('status')?.textContent.includes(text), word);

async function checkSteering() {
  await page.goto(await run.address);
  await until(() => Boolean(window.zwang));
  await page.keyboard.press('Space');
  await status('paused');
  const before = await tick(false);
  assert.equal(await settled(), before + 1, 'one tick, and a run that is paused stands');
  // What a browser may not do is refused by the program.
  const policy = await page.getAttribute('meta[http-equiv]', 'content');
  assert.match(policy, /default-src 'none'.*connect-src ws:\/\/127\.0\.0\.1:\d+;/);
  assert.doesNotMatch(policy, /unsafe/);
}

async function checkRestart() {
  const before = await records();
  await page.evaluate(() => { window.isOld = true; });
  await press('#restart');
  await until(() => !window.isOld && Boolean(window.zwang));
  await status('paused');
  assert.ok(await records() < before, 'the run begins anew');
}

/** By the keyboard alone: the slider's end is the end of the declared range. */
async function checkParameter() {
  await page.locator('[data-parameter=push]').focus();
  await page.keyboard.press('End');
  while (await last('params.push') !== 40) await tick();
  await page.locator('#set-push').fill('400');
  await page.keyboard.press('Enter');
  await status('refused');
  await tick();
  assert.equal(await last('params.push'), 40);
}

/** The force grows with the way that the base is dragged, and is in the log. A base that is let go is not pushed. */
async function checkPush() {
  const canvas = page.locator('figure canvas').first();
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  const [held, scale] = await page.evaluate(() => {
    const { run, top } = window.zwang;
    const base = ['x', 'y'].map((axis) => run.sample(`truth.base.${axis}`).at(-1));
    return [top.mapping()(base), top.mapping()([1, 0])[0] - top.mapping()([0, 0])[0]];
  });
  const [x, y] = [box.x + held[0], box.y + held[1]];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - 60, { steps: 4 });
  // The hand tells of its way now and then: until a tick has it.
  const strength = (150 * 60) / scale;
  for (let fy = 0; !(Math.abs(fy - strength) < 3); fy = await last('hand.force.y')) await tick(false);
  const force = () => page.evaluate(() => ['x', 'y'].map((axis) => window.zwang.run.curve(`hand.force.${axis}`).at(-1)));
  const [fx, fy] = await force();
  assert.ok(Math.abs(fx) < 3 && Math.abs(fy - (150 * 60) / scale) < 3, `pushed with ${fx}, ${fy} N over ${60 / scale} m`);
  await page.mouse.up();
  while (await last('hand.force.y') !== 0) await tick(false);
}

async function checkLook() {
  for (const [width, colorScheme] of look ? looks : looks.slice(0, 1)) {
    await page.setViewportSize({ width, height: 900 });
    await page.emulateMedia({ colorScheme });
    // The page's charts and views follow its width at their own pace.
    await until((wide) => innerWidth === wide && document.documentElement.scrollWidth <= wide, width);
    assert.deepEqual(await tooFaint(page), [], `contrast at ${width} px, ${colorScheme}`);
    if (look) await page.screenshot({ path: `${folder}/live_${width}_${colorScheme}.png`, fullPage: true });
  }
}

async function checkGoingOn() {
  const before = await records();
  await press('#pause');
  await until((count) => window.zwang.run.data.records > count + 500, before);
  const [time, x] = await page.evaluate(() => [window.zwang.run.duration, window.zwang.run.sample('truth.base.x').at(-1)]);
  assert.ok(time > 0.4 && x !== 0, `after ${time} s the base is at x ${x}`);
}

async function checkEnd() {
  run.process.kill('SIGINT');
  assert.ok([0, 1].includes(await run.ended), 'done, or interrupted before');
  await status('has ended');
  execFileSync(zwang, ['replay', `${folder}/${run.name}/log.mcap`]);
}

/** A base that rolls freely, its heading held, beside a post that it never meets. */
function beginCoasting() {
  writeFileSync(`${folder}/coast.yaml`, `zwang: 2
robot: mecanum_base.yaml
start: coast
tasks:
  coast:
    constraints: {straight: {move: base, in: world, rz: {position: here}}}
    exits: [{when: elapsed > 10 min, goto: done}]
`);
  writeFileSync(`${folder}/far.yaml`, `zwang_scene: 1
objects: {post: {cylinder: {radius: 0.1 m, height: 1 m}, at: [4 m, 0 m], fixed: true}}
`);
  return begin('coast', `${folder}/coast.yaml`, '--robot', `${specs}/robots/mecanum_base.yaml`, '--scene', `${folder}/far.yaml`);
}

/** The mouse pulls the robot aside for a while, and lets go; then the base rolls on. */
async function checkPull() {
  await page.goto(await run.address);
  await until(() => Boolean(window.zwang));
  const canvas = page.locator('figure canvas').first();
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  const held = await page.evaluate(() => window.zwang.top.mapping()([0, 0]));
  await page.mouse.move(box.x + held[0], box.y + held[1]);
  await page.mouse.down();
  await page.mouse.move(box.x + held[0] + 5, box.y + held[1] - 15, { steps: 4 });
  await until(() => Math.hypot(...['x', 'y'].map((axis) => window.zwang.run.sample(`truth.base.${axis}`).at(-1))) > 0.02);
  await page.mouse.up();
  const before = await page.evaluate(() => window.zwang.run.duration);
  await until((time) => window.zwang.run.duration > time + 1, before);
}

/** The momentum that the hand gave is that of the base: m_e v = integral of F dt, and its motors gave nothing. */
async function checkMotion() {
  // Each wheel turns by v/r, whichever way the base goes: m_e = m + sum (I + g^2 J) / r^2. Figures of the URDF and the robot file.
  const mass = 36.8 + 4 * 2.3 + (4 * (0.0066249 + 26 ** 2 * 13.5e-6)) / 0.0759 ** 2;
  const csv = execFileSync(zwang, ['log', `${folder}/${run.name}`], { encoding: 'utf8', maxBuffer: 2 ** 30 });
  const [head, ...lines] = csv.trimEnd().split('\n').map((line) => line.split(','));
  const names = head.map((name) => name.replace(/ \[.*/, ''));
  const column = (name) => lines.map((line) => Number(line[names.indexOf(name)]));
  const time = column('time');
  const forces = ['x', 'y'].map((axis) => column(`hand.force.${axis}`));
  const pushed = time.map((_, i) => forces[0][i] !== 0 || forces[1][i] !== 0);
  const [first, after] = [pushed.indexOf(true), pushed.lastIndexOf(true) + 1];
  assert.ok(first > 0 && after < time.length - 500, 'it stood before, and rolled on for half a second');
  const end = after + 500;
  const [impulse, momentum] = [[0, 0], [0, 0]];
  ['x', 'y'].forEach((axis, k) => {
    const place = column(`truth.base.${axis}`);
    assert.ok(Math.abs(place[first] - place[0]) < 1e-6, 'a base that nobody pushes stands');
    impulse[k] = forces[k].reduce((sum, force, i) => sum + (i ? force * (time[i] - time[i - 1]) : 0), 0);
    momentum[k] = (mass * (place[end] - place[after])) / (time[end] - time[after]);
  });
  // The hand holds the base up to 2 cm beside its origin, so the base turns by a degree: a hundredth.
  const apart = Math.hypot(momentum[0] - impulse[0], momentum[1] - impulse[1]);
  assert.ok(apart < 0.01 * Math.hypot(...impulse), `${impulse} N s of the hand, ${momentum} N s of the base`);
}

/** A task that waits as long as its signal is true, and a scene with a post. */
function beginWaiting() {
  writeFileSync(`${folder}/wait.yaml`, `zwang: 1
robot: mecanum_base.yaml
signals: {gate: {type: bool, stale_after: 50 ms}}
start: wait
tasks:
  wait:
    constraints: {stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    exits: [{when: not gate, goto: done}]
`);
  writeFileSync(`${folder}/post.yaml`, `zwang_scene: 1
objects: {post: {cylinder: {radius: 0.1 m, height: 1 m}, at: [1 m, 0 m], fixed: true}}
signals: {gate: {script: [[0 s, true]]}}
`);
  return begin('hand', `${folder}/wait.yaml`, '--robot', `${specs}/robots/mecanum_base.yaml`, '--scene', `${folder}/post.yaml`);
}

/** A signal is blocked by the keyboard, and the log has it. */
async function checkBlocking() {
  await page.goto(await run.address);
  await until(() => Boolean(window.zwang));
  await page.keyboard.press('Space');
  await status('paused');
  await page.locator('#block-gate').focus();
  await page.keyboard.press('Space');
  await until(() => document.getElementById('block-gate').checked);
  while (await last('hand.blocked.gate') !== 1) await tick();
  await page.keyboard.press('Space');
  while (await last('hand.blocked.gate') !== 0) await tick();
}

/** A fault is chosen, put on and ended by the keyboard. */
async function checkFaults() {
  await page.locator('#fault').selectOption('payload');
  await page.locator('#fault-number').fill('5');
  await page.locator('#fault-put').focus();
  await page.keyboard.press('Enter');
  await until(() => document.querySelector('.in-force')?.textContent.includes('payload: 5 kg'));
  while (await last('hand.fault.payload') !== 5) await tick();
  await page.locator('.in-force button').focus();
  await page.keyboard.press('Enter');
  await until(() => document.querySelectorAll('.in-force li').length === 0);
  while (!Number.isNaN(await last('hand.fault.payload'))) await tick();
  await page.locator('#fault-number').fill('1e6');
  await press('#fault-put');
  await status('refused');
}

/** An object goes where the fields say, then where it is dragged. */
async function checkObjects() {
  await page.locator('#object-y').fill('0.05');
  await page.locator('#object-move').focus();
  await page.keyboard.press('Enter');
  while (await last('hand.to.y') !== Math.fround(0.05)) await tick();
  await press('#pause');
  await until(() => Math.abs(window.zwang.run.sample('truth.post.y').at(-1) - 0.05) < 1e-3);
  await press('#pause');
  await status('paused');
  await settled();
  await press('#now');
  const canvas = page.locator('figure canvas').first();
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox();
  const [x, y, scale] = await page.evaluate(() => {
    const to = window.zwang.top.mapping();
    return [...to([1, 0.05]), to([1, 0])[0] - to([0, 0])[0]];
  });
  await page.mouse.move(box.x + x, box.y + y);
  await page.mouse.down();
  await page.mouse.move(box.x + x, box.y + y - 40, { steps: 4 });
  await page.mouse.up();
  while (await last('hand.to.y') === Math.fround(0.05)) await tick();
  const to = await last('hand.to.y');
  assert.ok(Math.abs(to - 0.05 - 40 / scale) < 3 / scale, `dragged to y ${to} m, ${40 / scale} m were meant`);
}

/** What the world does to the task: a gate that is not seen for longer than its `stale_after` is unknown, no exit. */
async function checkOutcome() {
  await page.locator('#fault').selectOption('samples');
  await page.locator('#fault-word').selectOption('lost');
  await press('#fault-put');
  await until(() => document.querySelector('.in-force')?.textContent.includes('samples: lost'));
  await press('#pause');
  await until(() => document.getElementById('status').textContent.includes('over'));
  assert.match(await page.textContent('#verdict'), /stopped/);
}

const looks = [360, 800, 1600].flatMap((width) => ['light', 'dark'].map((scheme) => [width, scheme]));
let run = begin('run', `${specs}/wall_align.yaml`);
const ofWall = [checkSteering, checkRestart, checkParameter, checkPush, checkGoingOn, checkLook, checkEnd];
const ofMass = [checkPull, checkEnd, checkMotion];
const byHand = [checkBlocking, checkFaults, checkObjects, checkLook, checkOutcome, checkEnd];
try {
  for (const steps of [ofWall, ofMass, byHand]) {
    if (steps === ofMass) run = beginCoasting();
    if (steps === byHand) run = beginWaiting();
    for (const step of steps) {
      const start = Date.now();
      await step();
      console.log(`ok ${step.name} (${Date.now() - start} ms)`);
    }
  }
  assert.deepEqual(complaints, []);
} finally {
  run.process.kill('SIGKILL');
  await browser.close();
}
