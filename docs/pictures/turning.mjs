// The animation of the README: a base that stands askew turns square at a wall. Views and curve are those of the run's page.
import { execFileSync } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { open, show } from './browser.mjs';

const framesASecond = 12;
const begin = 5.6;    // [s] shortly before the base touches
const standing = 1.5; // [s] at the end

const stage = `
  #page { padding: 0; } body { overflow: hidden; }
  header.verdict, .controls, aside, figcaption, section > h2, #page section:not(#views, #curves),
  .chart:not(#chart-other), .chart select, .note, .remove { display: none; }
  main { display: block; } section { margin: 0; border: 0; padding: 6px 10px; background: none; }
  .views { grid-template-columns: 1fr 1fr; } .view { height: 330px; border: 0; background: none; }
  .plot { min-height: 0; } .chart h3 { margin: 0; }
  #moment { position: absolute; left: 14px; top: 8px; font: 600 17px ui-monospace, monospace; }`;

/** The chart of what has no chart of its own shows the heading alone. */
async function showHeading(page) {
  const chart = page.locator('#chart-other');
  while (await chart.locator('.remove').count()) await chart.locator('.remove').first().evaluate((button) => button.click());
  await chart.locator('select').evaluate((select) => {
    select.value = [...select.options].find((option) => option.text.startsWith('truth.base.yaw')).value;
    select.dispatchEvent(new Event('change'));
  });
  await chart.locator('h3').evaluate((title) => { title.textContent = 'Heading of the base to the wall, as the simulator measures it [deg]'; });
}

async function zoom(page, view, by) {
  await page.locator('canvas.view').nth(view).dispatchEvent('wheel', { deltaY: by });
}

export async function turning(browser, run, out, folder) {
  mkdirSync(folder, { recursive: true });
  const page = await open(browser, `file://${run}.html`, [860, 560], stage);
  await showHeading(page);
  await zoom(page, 0, -160);
  for (let i = 0; i < 6; ++i) await zoom(page, 1, -120);
  await page.evaluate(() => document.body.append(Object.assign(document.createElement('div'), { id: 'moment' })));
  const end = await page.evaluate(() => window.zwang.run.data.tasks.find((one) => one.task === 'done').begin - window.zwang.run.data.begin);
  const frames = [];
  for (let time = begin; time < end; time += 1 / framesASecond) {
    await show(page, time);
    await page.evaluate((text) => { document.getElementById('moment').textContent = text; }, `${time.toFixed(1)} s`);
    frames.push(`${folder}/${String(frames.length).padStart(3, '0')}.png`);
    await page.screenshot({ path: frames.at(-1) });
  }
  const duration = Math.round(1000 / framesASecond);
  execFileSync('img2webp', ['-loop', '0', '-lossy', '-q', '70', '-m', '6', '-d', `${duration}`, ...frames.slice(0, -1),
    '-d', `${1000 * standing}`, frames.at(-1), '-o', out], { stdio: 'pipe' });
  await page.context().close();
}
