// The page of a run, in a browser: what it shows is what the log says, it needs nothing else, and it can be used.
// usage: node check.mjs ZWANG SPECS FOLDER CHROMIUM [WORDS]: the steps whose names have the words; all without them
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tooFaint } from './contrast.mjs';
import { checkLeaning, checkPath } from './scene.mjs';
import { checkScrub } from './scrub.mjs';

const [zwang, specs, folder, chromium, only = ''] = process.argv.slice(2);
const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium: browsers } = require('playwright-core');

function makePage(name, task, ...more) {
  const run = spawnSync(zwang, ['run', task, '--log', `${folder}/${name}`, '--format', 'json', ...more], { encoding: 'utf8' });
  const report = JSON.parse(run.stdout);
  execFileSync(zwang, ['report', `${folder}/${name}`, '-o', `${folder}/${name}.html`]);
  return { name, report, path: `${folder}/${name}.html`, csv: readCsv(`${folder}/${name}`) };
}

/** The columns of a run's log by their names without the unit. */
function readCsv(run) {
  const csv = execFileSync(zwang, ['log', run], { encoding: 'utf8', maxBuffer: 2 ** 30 });
  const [head, ...lines] = csv.trimEnd().split('\n').map((line) => line.split(','));
  const columns = new Map(head.map((name, i) => [name.replace(/ \[.*/, ''), i]));
  const column = (name) => lines.map((line) => (line[columns.get(name)] === '' ? NaN : Number(line[columns.get(name)])));
  return { column, has: (name) => columns.has(name), count: lines.length };
}

// As on a computer without a graphics card: the processors draw what is in space, and put the page together.
const browser = await browsers.launch({ executablePath: chromium, args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader'] });

/** Opens a page without any network; a complaint of the browser fails the test. */
async function open(path, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1600, height: 1000 }, offline: true, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) complaints.push(message.text()); });
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) complaints.push(`asks for ${request.url()}`); });
  page.on('dialog', (dialog) => { complaints.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  await page.goto(`file://${path}`);
  // The page's policy forbids the evaluation by which `waitForFunction` asks a second time.
  for (let i = 0; i < 600 && !await page.evaluate(() => Boolean(window.zwang)); ++i) await page.waitForTimeout(100);
  return { page, complaints, close: async () => { assert.deepEqual(complaints, []); await context.close(); } };
}

async function checkNumbers(made) {
  const { page, close } = await open(made.path);
  assert.equal(await page.textContent('#verdict'), made.report.verdict);
  const [time, x, y, yaw] = ['time', 'truth.base.x', 'truth.base.y', 'truth.base.yaw'].map(made.csv.column);
  for (const share of [0, 0.31, 0.66, 1]) {
    const i = Math.round(share * (time.length - 1));
    await page.evaluate((at) => window.zwang.clock.show(at), time[i] - time[0]);
    const pose = await page.getAttribute('figure canvas', 'data-pose');
    pose.split(' ').map(Number).forEach((value, k) => {
      const logged = [x, y, yaw][k][i];
      // Between two samples the pose is interpolated: at 1 m/s and 1 rad/s, over a few records.
      assert.ok(Math.abs(value - logged) < 2e-3, `${made.name} at ${time[i]} s: ${value} is ${logged} in the log`);
    });
  }
  // Every extreme of every curve is there, as a 32-bit float has it.
  const extremes = await page.evaluate(() => [...window.zwang.run.columns.keys()].map((name) => {
    const values = [...window.zwang.run.curve(name)].filter((value) => !Number.isNaN(value));
    return [name, Math.min(...values), Math.max(...values)];
  }));
  assert.ok(extremes.length > 30);
  for (const [name, least, largest] of extremes) {
    const logged = made.csv.column(name).filter((value) => !Number.isNaN(value));
    let [low, high] = [Infinity, -Infinity];
    for (const value of logged) [low, high] = [Math.min(low, value), Math.max(high, value)];
    for (const [shown, is] of [[least, low], [largest, high]])
      assert.ok(Math.abs(shown - is) <= 1e-6 * Math.max(1, Math.abs(is)), `${made.name}, ${name}: ${shown} is ${is} in the log`);
  }
  const limits = await page.locator('#margins tbody tr').count();
  assert.equal(limits, made.report.limits.length);
  const broken = made.report.limits.filter((limit) => limit.broken).length;
  assert.equal(await page.locator('#margins tr.broken').count(), broken);
  await close();
}

/** A row of a range has bars while less than a hundredth of its range is left, by the records themselves. */
async function checkRangeAtLimit(made) {
  const { page, close } = await open(made.path);
  const bound = await page.evaluate(() => {
    const { bounds } = window.zwang.run.data;
    return bounds.find((one) => one.column.endsWith('contact.x.velocity'));
  });
  const [time, value] = ['time', bound.column].map(made.csv.column);
  const near = value.filter((one) => Math.min(bound.high - one, one - bound.low) < 0.01 * (bound.high - bound.low)).length / time.length;
  assert.ok(near > 0.02, `${bound.column} is at its limit for ${near} of the run`);
  const shown = await page.evaluate((column) => [...document.querySelectorAll('.band-row')]
    .filter((row) => row.querySelector('.band-name')?.textContent === column)
    .flatMap((row) => [...row.querySelectorAll('.bar.limit')]).reduce((sum, bar) => sum + Number.parseFloat(bar.style.width), 0) / 100, bound.column);
  assert.ok(Math.abs(shown - near) < 0.02, `${bound.column}: bars of ${shown} of the run, in the log ${near}`);
  await close();
}

/** No word of the top view lies over another one or over its edge, at any time, however near it is seen. */
async function checkLabels(page, width) {
  const found = await page.evaluate(() => {
    const { top, clock } = window.zwang;
    const canvas = top.element.querySelector('canvas');
    const complaints = [];
    const over = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
    let most = 0;
    for (const zoom of [1, 0.2, 5]) {
      top.setZoom(zoom);
      for (let i = 0; i <= 4; ++i) {
        clock.show(clock.duration * i / 4);
        const boxes = top.shownLabels;
        most = Math.max(most, boxes.length);
        boxes.forEach((a, k) => {
          if (a.left < 0 || a.top < 0 || a.right > canvas.clientWidth || a.bottom > canvas.clientHeight) complaints.push(`${a.text} is cut`);
          boxes.slice(k + 1).forEach((b) => { if (over(a, b)) complaints.push(`${a.text} over ${b.text}`); });
        });
      }
    }
    top.setZoom(1);
    return { complaints: [...new Set(complaints)], most };
  });
  assert.deepEqual(found.complaints, [], `labels at ${width} px`);
  assert.ok(found.most >= 2);
}

async function checkUse(made) {
  const { page, close } = await open(made.path);
  const now = () => page.evaluate(() => window.zwang.clock.time);
  await page.locator('body').click({ position: { x: 3, y: 3 } });
  await page.keyboard.press('End');
  assert.ok(await now() > 0);
  await page.keyboard.press('Home');
  assert.equal(await now(), 0);
  await page.keyboard.press('Shift+ArrowRight');
  assert.ok(Math.abs(await now() - 0.1 * await page.evaluate(() => window.zwang.run.duration)) < 1e-6);
  await page.keyboard.press('Space');
  await page.waitForTimeout(300);
  await page.keyboard.press('Space');
  const paused = await now();
  assert.ok(paused > 0.1, 'it played');
  await page.waitForTimeout(200);
  assert.equal(await now(), paused, 'it pauses');
  // A line shows its curve, a curve its line.
  const line = page.locator('#source button.line').first();
  const title = await line.getAttribute('title');
  await line.click();
  const name = title.replace('Show ', '');
  assert.equal(await page.locator(`output[data-curve="${name}"]`).count(), 1, name);
  await page.locator('#margins td:last-child button.link').last().click();
  assert.equal(await page.locator('.row.shown').count(), 1);
  // The keyboard alone reaches play, time, speed.
  await page.locator('.play').focus();
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.className), 'scrub');
  await close();
}

async function checkLook(made, looks) {
  for (const [width, colorScheme] of looks) {
    const { page, close } = await open(made.path, { viewport: { width, height: 900 }, colorScheme, reducedMotion: 'reduce' });
    await page.evaluate(() => window.zwang.clock?.show(0.7 * window.zwang.clock.duration));
    const closed = page.locator('.cells .head').first();
    if (await closed.count()) await closed.click();
    await page.waitForTimeout(200);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wide <= 0, `${width} px: the page is ${wide} px too wide`);
    const overlaps = await page.evaluate(() => {
      const boxes = [...document.querySelectorAll('section, .verdict, .chart, figure, .cells > li')].map((element) => [element, element.getBoundingClientRect()]);
      const found = [];
      boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
        if (a.contains(b) || b.contains(a)) return;
        if (p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 1 && q.top < p.bottom - 1) found.push(`${a.id || a.className} over ${b.id || b.className}`);
      }));
      return found;
    });
    assert.deepEqual(overlaps, [], `${width} px`);
    const cut = await page.evaluate(() => [...document.querySelectorAll('.scroll:has(.fits), .band-name')]
      .filter((one) => one.scrollWidth > one.clientWidth + 1).map((one) => one.textContent.slice(0, 40)));
    assert.deepEqual(cut, [], `cut at ${width} px`);
    // Each look at the labels draws both views, and without a graphics card the one in space takes its time.
    if (width === 360 && await page.evaluate(() => Boolean(window.zwang.top))) await checkLabels(page, width);
    assert.deepEqual(await tooFaint(page), [], `contrast at ${width} px, ${colorScheme}`);
    await page.screenshot({ path: `${folder}/${made.name}_${width}_${colorScheme}.png`, fullPage: true });
    await close();
  }
}

/** Two runs of unlike length: what the page says of them is what their CSV logs say. */
async function checkComparison(a, b, path) {
  execFileSync(zwang, ['report', `${folder}/${a.name}`, '--compare', `${folder}/${b.name}`, '-o', path]);
  const { page, close } = await open(path);
  assert.equal(await page.textContent('#verdict-A'), a.report.verdict);
  assert.equal(await page.textContent('#verdict-B'), b.report.verdict);
  // A CSV has nine digits: it parts from the other where the page says, or later, and has the page's values there.
  const [times, others] = [a, b].map((made) => made.csv.column('time'));
  const found = await page.evaluate(() => window.zwang.comparison.columns.filter((one) => !one.input));
  let exact = 0;
  for (const one of found.slice(0, 60)) {
    if (Number.isNaN(Number(one.first)) || Number.isNaN(Number(one.second))) continue;  // words
    const [mine, its] = [a, b].map((made) => made.csv.column(one.name));
    const at = times.findIndex((time) => Math.abs(time - one.time) < 1e-9);
    const parted = times.findIndex((_, k) => k < others.length && mine[k] !== its[k] && !(Number.isNaN(mine[k]) && Number.isNaN(its[k])));
    assert.ok(at >= 0 && (parted < 0 || parted >= at), `${one.name} parts at ${times[parted]} s, the page says ${one.time}`);
    exact += parted === at ? 1 : 0;
    for (const [shown, is] of [[one.first, mine[at]], [one.second, its[at]]])
      assert.ok(shown === '' ? Number.isNaN(is) : Math.abs(Number(shown) - is) <= 1e-8 * Math.max(1e-6, Math.abs(is)), `${one.name}: ${shown} is ${is}`);
  }
  assert.ok(exact > 20, `${exact} columns part where the CSV does`);
  // Both poses, at a time that both runs have, and behind the end of the shorter one.
  const pose = (made, time) => {
    const t = made.csv.column('time');
    const i = Math.min(t.length - 1, Math.round(time / (t[1] - t[0])));
    return ['truth.base.x', 'truth.base.y', 'truth.base.yaw'].map((name) => made.csv.column(name)[i]);
  };
  const end = Math.max(times.at(-1), others.at(-1));
  for (const time of [0, 0.4 * end, end]) {
    await page.evaluate((at) => window.zwang.clock.show(at), time);
    for (const [made, attribute] of [[a, 'data-pose'], [b, 'data-other-pose']]) {
      const shown = (await page.getAttribute('figure canvas', attribute)).split(' ').map(Number);
      pose(made, time).forEach((is, k) => assert.ok(Math.abs(shown[k] - is) < 2e-3, `${attribute} at ${time} s: ${shown[k]} is ${is}`));
    }
  }
  const over = await page.locator('.legend output').allTextContents();
  assert.ok(over.includes('over') && over.some((text) => text !== 'over'), 'the shorter run is over');
  // A click on a column shows both of its curves on one axis, and adds them if need be.
  const names = await page.locator('#first td button.link[title]').allTextContents();
  await page.locator('#first td button.link[title]').last().click();
  const shown = page.locator(`[data-pair="${names.at(-1)}"]`);
  assert.equal(await shown.count(), 1);
  assert.equal(await shown.locator('li').count(), 2);
  assert.equal(await page.locator('#transitions .unlike').count() > 0, true);
  await page.locator('body').click({ position: { x: 3, y: 3 } });
  await page.keyboard.press('Home');
  assert.equal(await page.evaluate(() => window.zwang.clock.time), 0);
  await close();
}

/** Runs of another task on another robot: the page says so, and still shows both. */
async function checkUnlikeRuns(a, b) {
  const path = `${folder}/unlike.html`;
  execFileSync(zwang, ['report', `${folder}/${a.name}`, '--compare', `${folder}/${b.name}`, '-o', path]);
  const { page, close } = await open(path);
  const text = await page.textContent('#before');
  for (const words of ['task', 'wall_align.yaml', 'docking.yaml', 'that run A alone has', 'that run B alone has']) assert.ok(text.includes(words), words);
  assert.ok(await page.locator('#curves .chart[data-pair]').count() > 3);
  await close();
}

/** A matrix in which one half misses what a hostile scenario expects. */
async function checkMatrix() {
  const at = `${folder}/matrix`;
  mkdirSync(`${at}/scenarios`, { recursive: true });
  for (const name of ['robots', 'scenes', 'wall_align.yaml']) cpSync(`${specs}/${name}`, `${at}/${name}`, { recursive: true });
  writeFileSync(`${at}/.zwang-root`, '');
  writeFileSync(`${at}/scenarios/square.yaml`, `zwang_scenario: 1
about: "</script><img src=x onerror=alert(1)>"
task: ../wall_align.yaml
matrix:
  params.push: [20 N, 30 N]
  start_yaw: [5 deg, 12 deg]
expect:
  - outcome: done
  - {at: end, that: truth.wall.steady < 21 N}
`);
  const page_ = `${folder}/matrix.html`;
  const made = spawnSync(zwang, ['test', `${at}/scenarios`, '--format', 'json', '--report', '-o', page_], { encoding: 'utf8' });
  const runs = JSON.parse(made.stdout).scenarios.flatMap((one) => one.runs);
  assert.ok(runs.some((run) => run.passed) && runs.some((run) => !run.passed), 'one half is missed');
  const { page, close } = await open(page_);
  assert.equal(await page.locator('img').count(), 0);
  assert.equal(await page.locator('.cells > li').count(), runs.length);
  const failed = runs.filter((run) => !run.passed).length;
  const words = await page.locator('.cells > li strong:first-child').allTextContents();
  assert.deepEqual(words.slice(0, runs.length), [...Array(failed).fill('✗ FAIL'), ...Array(runs.length - failed).fill('✓ ok')]);
  // The keyboard opens the worst run: what was missed, what happened, and the command.
  const head = page.locator('.cells .head').first();
  await head.focus();
  await page.keyboard.press('Enter');
  assert.equal(await head.getAttribute('aria-expanded'), 'true');
  const worst = page.locator('.cells > li').first();
  assert.match(await worst.locator('.command code').textContent(), /^zwang run .*square\.yaml --cell '.*' --report$/);
  assert.ok(await worst.locator('tr.broken').count() >= 1);
  assert.equal(await worst.locator('svg .way').count(), 1);
  await page.locator('#failed').check();
  assert.equal(await page.locator('.cells > li:visible').count(), failed);
  await page.locator('#failed').uncheck();
  await page.locator('input[type=search]').fill('12 deg');
  assert.equal(await page.locator('.cells > li:visible').count(), 2);
  await close();
  assert.ok(statSync(page_).size < 1e6);
}

/** A task whose name and comments try to be HTML: the language takes such a comment, and a parameter's help. */
/** A study whose second expectation one half misses: its shares, its points, the strongest draw first. */
async function checkStudy() {
  const at = `${folder}/study`;
  mkdirSync(at, { recursive: true });
  for (const name of ['robots', 'scenes', 'wall_align.yaml']) cpSync(`${specs}/${name}`, `${at}/${name}`, { recursive: true });
  writeFileSync(`${at}/.zwang-root`, '');
  writeFileSync(`${at}/push.yaml`, `zwang_study: 1
about: "</script><img src=x onerror=alert(1)>"
task: wall_align.yaml
runs: 24
draw:
  params.push: {uniform: [10 N, 30 N]}
  start.yaw: {uniform: [-5 deg, 5 deg]}
expect:
  - outcome: done
  - {at: end, that: truth.wall.steady < 20 N, probability: 90 %}
`);
  const made = spawnSync(zwang, ['sweep', `${at}/push.yaml`, '--out', `${at}/push.db`, '--format', 'json', '--report'], { encoding: 'utf8' });
  const report = JSON.parse(made.stdout);
  const { page, close } = await open(`${at}/push.html`);
  assert.equal(await page.locator('img').count(), 0);
  const claims = page.locator('#claims .cells > li');
  assert.deepEqual(await claims.locator('.head strong').allTextContents(), report.expectations.map((one) => ({ held: '✓ held', broken: '✗ broken', 'too few runs': '? too few runs' })[one.verdict]));
  assert.equal(report.expectations[1].verdict, 'broken', 'pushes above 20 N are one half');
  const points = await page.evaluate(() => window.zwang.data.points);
  assert.equal(points.cells.length, report.cells);
  assert.equal(points.expectations[1].held.filter(Boolean).length, report.expectations[1].held);
  // The push decides: its chart comes first behind the histogram, and something is drawn on each.
  const broken = claims.nth(1);
  assert.match(await broken.locator('figcaption').nth(1).textContent(), /params\.push/);
  for (const canvas of await broken.locator('canvas').all())
    assert.ok(await canvas.evaluate((one) => new Set(new Uint32Array(one.getContext('2d').getImageData(0, 0, one.width, one.height).data.buffer)).size) > 2);
  assert.match(await page.locator('#worst code').first().textContent(), /^zwang run .*push\.yaml --cell \d+ --report$/);
  // The keyboard opens and closes an expectation.
  const head = broken.locator('.head');
  await head.focus();
  await page.keyboard.press('Enter');
  assert.equal(await broken.locator('canvas').count(), 0);
  await close();
}

async function checkHostile() {
  const text = readFileSync(`${specs}/laws/fence.yaml`, 'utf8');
  mkdirSync(`${folder}/hostile`, { recursive: true });
  const task = `${folder}/hostile/a </script><img src=x onerror=alert(1)>.yaml`.replace('</script>', '<\u2215script>');
  writeFileSync(task, `# </script><script>alert(1)</script><!-- <img src=x onerror=alert(2)>\n${text}`);
  const made = makePage('hostile_run', task, '--robot', `${specs}/robots/mecanum_base.yaml`, '--scene', `${specs}/scenes/open.yaml`);
  const { page, close } = await open(made.path);
  assert.equal(await page.locator('img').count(), 0);
  assert.equal(await page.locator('script').count(), 2);
  assert.ok((await page.locator('#source .code').first().textContent()).startsWith('# </script><script>alert(1)'));
  const policy = await page.getAttribute('meta[http-equiv]', 'content');
  assert.ok(/default-src 'none'/.test(policy) && !/unsafe/.test(policy), policy);
  await close();
}

const wall = makePage('wall', `${specs}/wall_align.yaml`);
const unseen = makePage('unseen', `${specs}/docking.yaml`, '--scene', `${specs}/scenes/dock_unseen.yaml`);
const askew = makePage('askew', `${specs}/wall_align.yaml`, '--start-yaw', '12 deg', '-p', 'push=30N');
const [comparison, matrix] = [{ name: 'comparison', path: `${folder}/comparison.html` }, { name: 'matrix', path: `${folder}/matrix.html` }];
const steps = {
  'numbers of the wall': () => checkNumbers(wall),
  'numbers of a long run': () => checkNumbers(unseen),
  'why': async () => {
    const { page, close } = await open(unseen.path);
    assert.match(await page.textContent('#verdict'), /`partner` was never received/);
    assert.ok(await page.locator('#why tr.holds').count() >= 3);
    // The page opens at the moment that decided.
    assert.equal(await page.evaluate(() => window.zwang.clock.time), unseen.report.why.time);
    await close();
  },
  'scrub': () => checkScrub(open, wall),
  'a range at its limit': () => checkRangeAtLimit(wall),
  'use': () => checkUse(wall),
  'look of the wall': () => checkLook(wall, [[360, 'light'], [800, 'light'], [1600, 'light'], [1600, 'dark']]),
  'look of a failure': () => checkLook(unseen, [[360, 'dark']]),
  'comparison': () => checkComparison(wall, askew, comparison.path),
  'look of a comparison': () => checkLook(comparison, [[360, 'dark'], [800, 'light'], [1600, 'light']]),
  'unlike runs': () => checkUnlikeRuns(wall, unseen),
  'matrix': checkMatrix,
  'study': checkStudy,
  'look of a study': () => checkLook({ name: 'study', path: `${folder}/study/push.html` }, [[360, 'light'], [800, 'dark'], [1600, 'light']]),
  'look of a matrix': () => checkLook(matrix, [[360, 'light'], [800, 'dark'], [1600, 'light']]),
  'leaning objects': () => checkLeaning(open, makePage('leaning', `${specs}/wall_align.yaml`, '--scene', `${specs}/scenes/wall_leans.yaml`)),
  'paths': () => checkPath(open, makePage('path', `${specs}/deliver.yaml`)),
  'hostile text': checkHostile,
};
try {
  for (const [name, step] of Object.entries(steps)) {
    if (!name.includes(only)) continue;
    const begin = Date.now();
    await step();
    console.log(`ok ${name} (${Date.now() - begin} ms)`);
  }
} finally {
  await browser.close();
}
