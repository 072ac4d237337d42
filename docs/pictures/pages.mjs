// Pictures of the pages: of a report, of a run that goes on, and of the tasks of a file.
import { spawn } from 'node:child_process';
import { open, show } from './browser.mjs';

const size = [1600, 1000];

/** The page of a report, at a share of its run's duration. */
export async function report(browser, run, share, out) {
  const page = await open(browser, `file://${run}.html`, size);
  const duration = await page.evaluate(() => window.zwang.clock.duration);
  await page.waitForTimeout(1000);  // the view in space starts after the rest
  await show(page, share * duration);
  await page.screenshot({ path: out });
  await page.context().close();
}

/** The graph of the tasks alone, with the path that the run took. */
export async function graph(browser, run, share, out) {
  const page = await open(browser, `file://${run}.html`, size, 'main { display: block !important; } aside { display: none; }');
  await show(page, share * await page.evaluate(() => window.zwang.clock.duration));
  await page.locator('#graph svg').screenshot({ path: out });
  await page.context().close();
}

function address(run) {
  return new Promise((resolve, reject) => {
    let told = '';
    run.on('exit', () => reject(new Error(`the live run ended: ${told}`)));
    run.stderr.on('data', (bytes) => {
      told += bytes;
      const found = told.match(/http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\//);
      if (found) resolve(found[0]);
    });
  });
}

/** A run that goes on, paused by the page at `time` [s]. */
export async function live(browser, zwang, task, time, out, folder) {
  const run = spawn(zwang, ['run', task, '--live', '--quiet', '--log', folder]);
  try {
    const page = await open(browser, await address(run), size);
    await page.waitForFunction((until) => window.zwang.run.duration > until, time, { timeout: 120000, polling: 50 });
    await page.locator('#pause').click();
    await page.waitForTimeout(3000);  // the charts follow at their own pace
    await page.screenshot({ path: out });
    await page.context().close();
  } finally {
    run.removeAllListeners('exit');
    run.kill('SIGKILL');
  }
}
