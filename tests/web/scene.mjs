// What stands in the top view: objects that lean, and paths. `open` opens the page of a run.
import assert from 'node:assert/strict';

/** A wall that leans back by 20 deg is drawn where the bumper meets it, and dashed what is seen of it from above. */
export async function checkLeaning(open, made) {
  const { page, close } = await open(made.path);
  const face = 0.85 + 0.15 * Math.tan((20 * Math.PI) / 180);  // [m] at the bumper's height
  const colours = await page.evaluate((points) => {
    const { top } = window.zwang;
    const shown = document.querySelector('figure canvas');
    // A copy is read: the browser warns of a canvas that is read again and again.
    const copy = Object.assign(document.createElement('canvas'), { width: shown.width, height: shown.height });
    const context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(shown, 0, 0);
    return points.map(([x, y]) => [...context.getImageData(...top.mapping()([x, y]).map(Math.round), 1, 1).data].join(' '));
  }, [[face - 0.025, 0.55], [face + 0.025, 0.55], [face + 0.05, 0.57]]);
  assert.notEqual(colours[0], colours[1], 'the foot of the wall is not where the base meets it');
  assert.equal(colours[1], colours[2]);
  await close();
}

/** The page has the points of the file, with the arc as chords, and names the path. */
export async function checkPath(open, made) {
  const { page, close } = await open(made.path);
  const { points, names } = await page.evaluate(() => ({
    points: window.zwang.run.data.world.paths[0].points, names: window.zwang.top.shownLabels.map((one) => one.text) }));
  assert.ok(names.includes('way'), names.join());
  const near = (a, b) => Math.abs(a - b) < 1e-9;
  assert.ok(near(points[0][0], 0) && near(points[0][1], 0) && near(points.at(-1)[0], 2) && near(points.at(-1)[1], 1.5));
  // Between the lines all of them are 0.6 m from the middle of the fillet.
  for (const [x, y] of points.slice(1, -1)) assert.ok(near(Math.hypot(x - 1.4, y - 0.6), 0.6), `${x} ${y}`);
  await close();
}
