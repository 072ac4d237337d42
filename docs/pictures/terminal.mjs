// A terminal with a command and what it printed.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, writeFileSync } from 'node:fs';

const asked = `zwang: 1
robot: robots/mecanum_base.yaml
scene: scenes/wall.yaml
start: press
tasks:
  press:
    constraints:
      contact: {move: base, in: base, x: {force: 900 N, velocity: +-0.08 m/s}, y: {velocity: 0 m/s}, rz: free}
    exits:
      - {when: abs(contact.x.velocity) < 5 mm/s and moved(base) > 2 cm, for: 0.5 s, goto: done}
    timeout: {after: 20 s, goto: failed}
`;

const style = `
  body { margin: 0; padding: 14px; background: #fff; width: max-content; }
  pre { margin: 0; padding: 16px 20px; border-radius: 8px; background: #10151c; color: #e8edf4; font: 14px/1.5 ui-monospace, monospace; }
  b { color: #6fdc9d; }`;

async function terminal(browser, command, output, out) {
  const page = await browser.newPage({ viewport: { width: 1400, height: 500 }, deviceScaleFactor: 1.5 });
  await page.setContent(`<!doctype html><style>${style}</style><pre><b></b><span></span></pre>`);
  await page.locator('b').evaluate((element, text) => { element.textContent = `$ ${text}\n`; }, command);
  await page.locator('span').evaluate((element, text) => { element.textContent = text; }, output.trimEnd());
  await page.locator('body').screenshot({ path: out });
  await page.close();
}

/** The task of the README, which asks for more force than the robot's limits let through. */
export async function diagnostic(browser, zwang, specs, out, folder) {
  mkdirSync(folder, { recursive: true });
  for (const name of ['robots', 'scenes']) cpSync(`${specs}/${name}`, `${folder}/${name}`, { recursive: true });
  writeFileSync(`${folder}/press.yaml`, asked);
  const { stdout, stderr } = spawnSync(zwang, ['validate', 'press.yaml'], { cwd: folder, encoding: 'utf8' });
  await terminal(browser, 'zwang validate press.yaml', stdout + stderr, out);
}
