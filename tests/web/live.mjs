// The page of a run that goes on: what it asks for happens to the program, and the log replays.
// usage: node live.mjs ZWANG SPECS FOLDER CHROMIUM
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { createRequire } from 'node:module';

const [zwang, specs, folder, chromium] = process.argv.slice(2);
const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium: browsers } = require('playwright-core');

const run = spawn(zwang, ['run', `${specs}/wall_align.yaml`, '--live', '--quiet', '--log', `${folder}/run`]);
const ended = new Promise((resolve) => run.on('exit', resolve));
const address = await new Promise((resolve) => {
  let told = '';
  run.stderr.on('data', (bytes) => {
    told += bytes;
    const found = told.match(/http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\//);
    if (found) resolve(found[0]);
  });
});
const browser = await browsers.launch({ executablePath: chromium, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const page = await browser.newPage({ viewport: { width: 1600, height: 900 }, reducedMotion: 'reduce' });
const complaints = [];
page.on('console', (message) => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) complaints.push(message.text()); });
page.on('pageerror', (error) => complaints.push(error.message));
page.on('request', (request) => { if (request.url() !== address && !request.url().startsWith('blob:')) complaints.push(`asks for ${request.url()}`); });

/** Until the page says so; a busy machine may take its time. The page's policy forbids what `waitForFunction` does. */
async function until(what, value) {
  const end = Date.now() + 60000;
  // A page that loads anew answers nothing meanwhile.
  while (!await page.evaluate(what, value).catch(() => false)) {
    assert.ok(Date.now() < end, `still not: ${what} of ${value}`);
    await page.waitForTimeout(50);
  }
}
/** A click that waits for no frame: without a graphics card a busy machine draws one in many seconds. */
const press = (button) => page.locator(button).dispatchEvent('click');
const records = () => page.evaluate(() => window.zwang.run.data.records);
const status = (word) => until((text) => document.getElementById('status')?.textContent.includes(text), word);

async function checkSteering() {
  await page.goto(address);
  await until(() => Boolean(window.zwang));
  await page.keyboard.press('Space');
  await status('paused');
  await page.waitForTimeout(300);
  const before = await records();
  await page.waitForTimeout(300);
  assert.equal(await records(), before, 'a run that is paused stands');
  await page.keyboard.press('.');
  await until((count) => window.zwang.run.data.records > count, before);
  await page.waitForTimeout(200);
  assert.equal(await records(), before + 1, 'one tick');
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
  await press('#tick');
  await until(() => window.zwang.run.curve('params.push').at(-1) === 40);
  await page.locator('#set-push').fill('400');
  await page.keyboard.press('Enter');
  await status('refused');
  await press('#tick');
  await page.waitForTimeout(300);
  assert.equal(await page.evaluate(() => window.zwang.run.curve('params.push').at(-1)), 40);
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
  await page.waitForTimeout(200);
  await page.keyboard.press('.');
  const force = () => page.evaluate(() => ['x', 'y'].map((axis) => window.zwang.run.curve(`hand.force.${axis}`).at(-1)));
  await until(() => window.zwang.run.curve('hand.force.y').at(-1) > 1);
  const [fx, fy] = await force();
  assert.ok(Math.abs(fx) < 3 && Math.abs(fy - (150 * 60) / scale) < 3, `pushed with ${fx}, ${fy} N over ${60 / scale} m`);
  await page.mouse.up();
  await page.waitForTimeout(200);
  await page.keyboard.press('.');
  await until(() => window.zwang.run.curve('hand.force.y').at(-1) === 0);
}

async function checkLook() {
  for (const [width, colorScheme] of [[360, 'light'], [800, 'dark'], [1600, 'light']]) {
    await page.setViewportSize({ width, height: 900 });
    await page.emulateMedia({ colorScheme });
    // The page's charts and views follow its width at their own pace.
    await until((wide) => innerWidth === wide && document.documentElement.scrollWidth <= wide, width);
    await page.screenshot({ path: `${folder}/live_${width}.png`, fullPage: true });
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
  run.kill('SIGINT');
  assert.ok([0, 1].includes(await ended), 'done, or interrupted before');
  await status('has ended');
  execFileSync(zwang, ['replay', `${folder}/run/log.mcap`]);
}

try {
  for (const step of [checkSteering, checkRestart, checkParameter, checkPush, checkGoingOn, checkLook, checkEnd]) {
    const begin = Date.now();
    await step();
    console.log(`ok ${step.name} (${Date.now() - begin} ms)`);
  }
  assert.deepEqual(complaints, []);
} finally {
  run.kill('SIGKILL');
  await browser.close();
}
