// Makes the pictures of README and docs from real runs; `./dev pictures` calls it.
// usage: node make.mjs ZWANG SPECS FOLDER CHROMIUM
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { axes } from './axes.mjs';
import { launch } from './browser.mjs';
import { graph, live, report } from './pages.mjs';
import { diagnostic } from './terminal.mjs';
import { turning } from './turning.mjs';

const [zwang, specs, out, chromium] = process.argv.slice(2);
const folder = mkdtempSync(`${tmpdir()}/pictures.`);

/** A run with its page; the name of both. */
function made(task) {
  const run = `${folder}/${task}`;
  execFileSync(zwang, ['run', `${specs}/${task}.yaml`, '--log', run, '--quiet'], { stdio: 'pipe' });
  execFileSync(zwang, ['report', run, '-o', `${run}.html`], { stdio: 'pipe' });
  return run;
}

const browser = await launch(chromium);
try {
  const [wall, hospital] = [made('wall_align'), made('hospital')];
  axes(zwang, specs, `${out}/axes.svg`, `${folder}/axes`);
  writeFileSync(`${out}/row.svg`, execFileSync('python3', [`${out}/row.py`]));
  await diagnostic(browser, zwang, specs, `${out}/diagnostic.png`, `${folder}/diagnostic`);
  await report(browser, hospital, 0.5, `${out}/report.png`);
  await graph(browser, hospital, 0.5, `${out}/graph.png`);
  await live(browser, zwang, `${specs}/wall_align.yaml`, 7.4, `${out}/live.png`, `${folder}/live`);
  await turning(browser, wall, `${out}/turning.webp`, `${folder}/frames`);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
