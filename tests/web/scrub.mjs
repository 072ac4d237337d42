// What a drag of the time costs, and where it ends. `open` opens the page of a run.
import assert from 'node:assert/strict';

/** One frame lays the page out once, whatever listens to the time; the view in space rests sharp, at the log's pose. */
export async function checkScrub(open, made) {
  const { page, close } = await open(made.path);
  const space = page.locator('.views canvas').nth(1);
  const [time, x, y, yaw] = ['time', 'truth.base.x', 'truth.base.y', 'truth.base.yaw'].map(made.csv.column);
  const i = Math.round(0.6 * (time.length - 1));
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable');
  const layouts = async () => (await session.send('Performance.getMetrics')).metrics.find((one) => one.name === 'LayoutCount').value;
  await space.and(page.locator('[data-ratio="2"]')).waitFor({ timeout: 60000 });
  const before = await layouts();
  const frames = 40;
  await page.evaluate(([end, count]) => new Promise((resolve) => {
    const step = (k) => {
      window.zwang.clock.show((end * k) / count);
      requestAnimationFrame(() => (k < count ? step(k + 1) : resolve()));
    };
    step(1);
  }), [time[i] - time[0], frames]);
  const each = (await layouts() - before) / frames;
  assert.ok(each < 2, `${each} layouts a frame`);
  for (let tries = 0; tries < 600; ++tries) {
    const pose = (await space.getAttribute('data-pose')).split(' ').map(Number);
    if (await space.getAttribute('data-ratio') === '2' && [x, y, yaw].every((column, k) => Math.abs(pose[k] - column[i]) < 2e-3)) return close();
    await page.waitForTimeout(100);
  }
  assert.fail('the view in space does not come to rest at the pose of the log');
}
