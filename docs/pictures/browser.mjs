// Chromium without a window, and what the pictures do with it.
import { createRequire } from 'node:module';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const { chromium } = require('playwright-core');

export const launch = (executablePath) =>
  chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader'] });

/** Opens a page of zwang. The page's policy is put aside, because a picture adds a style of its own. */
export async function open(browser, address, [width, height], style = '') {
  const context = await browser.newContext({ viewport: { width, height }, bypassCSP: true, colorScheme: 'light' });
  const page = await context.newPage();
  await page.goto(address);
  await page.waitForFunction(() => Boolean(window.zwang), null, { timeout: 60000 });
  if (style) await page.addStyleTag({ content: style });
  return page;
}

/** Shows the moment [s] of the run, and waits until it is on the screen; the view in space is sharp once it rests. */
export async function show(page, time) {
  await page.evaluate(async (moment) => {
    window.zwang.clock.show(moment);
    const frame = () => new Promise((next) => { requestAnimationFrame(next); });
    for (let i = 0; i < 2; ++i) await frame();
    const [top, space] = document.querySelectorAll('.views canvas');
    if (!space?.dataset.ratio || !space.checkVisibility()) return;
    const { bottom } = space.getBoundingClientRect();
    const isSharp = () => space.dataset.pose === top.dataset.pose && Number(space.dataset.ratio) >= 2;
    while (bottom > 0 && !isSharp()) await frame();
  }, time);
}
