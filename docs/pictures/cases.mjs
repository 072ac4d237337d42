// A picture of each use case of the tutorial's part 4: both views of its run's page, at the moment that matters.
import { execFileSync } from 'node:child_process';
import { open, show } from './browser.mjs';

const stage = `
  #page { padding: 0; } body { overflow: hidden; }
  header.verdict, .controls, aside, figcaption, section > h2, #page section:not(#views) { display: none; }
  main { display: block; } section { margin: 0; border: 0; padding: 6px 10px; background: none; }
  .views { grid-template-columns: 1fr 1fr; } .view { height: 300px; border: 0; background: none; }`;

/** When each is seen, as a share of its run; by how many steps each view is nearer: from above, in space. */
const cases = {
  guide: [0.45, 0, 5],
  follow_wall: [0.7, 0, 3],
  cart: [0.8, 0, 5],
  patrol: [0.16, 0, 3],
  door: [0.9, 0, 4],
  cradle: [0.6, 0, 5],
  button: [0.66, 1, -2],
  drawer: [0.95, 1, 1],
  carry: [0.7, 0, 4],
  peg: [0.95, 1, -2],
  handover: [0.73, 1, -2],
  bumper: [0.9, 0, 4],
  approach_car: [0.6, 0, 6],
};

/** What runs: the task file, or where that has no end a cell of its scenario. */
export const runs = Object.keys(cases).map((task) =>
  [task, task === 'patrol' ? ['scenarios/patrol.yaml', '--cell', 'robot mecanum_base'] : [`${task}.yaml`]]);

/** `run` is the name of a run of `task` and of its page. */
export async function useCase(browser, run, task, out) {
  const [share, above, inSpace] = cases[task];
  const page = await open(browser, `file://${run}.html`, [800, 312], stage);
  await page.waitForTimeout(1000);  // the view in space starts after the rest
  for (const [view, steps] of [[0, above], [1, inSpace]]) {
    const turn = { deltaY: steps > 0 ? -120 : 120 };
    for (let i = 0; i < Math.abs(steps); ++i) await page.locator('canvas.view').nth(view).dispatchEvent('wheel', turn);
  }
  await show(page, share * await page.evaluate(() => window.zwang.clock.duration));
  await page.waitForTimeout(300);
  await page.screenshot({ path: `${run}.png` });
  execFileSync('img2webp', ['-lossy', '-q', '80', '-m', '6', `${run}.png`, '-o', out], { stdio: 'pipe' });
  await page.context().close();
}
