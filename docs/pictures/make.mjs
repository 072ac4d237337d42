// Makes the pictures of README and docs from real runs; `./dev pictures` calls it.
// usage: node make.mjs ZWANG SPECS FOLDER CHROMIUM
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { axes } from './axes.mjs';
import { launch } from './browser.mjs';
import { runs, useCase } from './cases.mjs';
import { graph, live, report } from './pages.mjs';
import { quantities } from './quantities.mjs';
import { diagnostic } from './terminal.mjs';
import { turning } from './turning.mjs';

const [zwang, specs, out, chromium] = process.argv.slice(2);
const folder = mkdtempSync(`${tmpdir()}/pictures.`);

/** A run with its page; the name of both. It may end as it likes, if it leaves a log. */
function made(task, [file, ...options] = [`${task}.yaml`]) {
  const run = `${folder}/${task}`;
  spawnSync(zwang, ['run', `${specs}/${file}`, ...options, '--log', run, '--quiet'], { stdio: 'pipe' });
  execFileSync(zwang, ['report', run, '-o', `${run}.html`], { stdio: 'pipe' });
  return run;
}

const browser = await launch(chromium);
try {
  const [wall, hospital] = [made('wall_align'), made('hospital')];
  axes(zwang, specs, `${out}/axes.svg`, `${folder}/axes`);
  quantities(zwang, specs, out, `${folder}/quantities`);
  writeFileSync(`${out}/row.svg`, execFileSync('python3', [`${out}/row.py`]));
  await diagnostic(browser, zwang, specs, `${out}/diagnostic.png`, `${folder}/diagnostic`);
  await report(browser, hospital, 0.5, `${out}/report.png`);
  await graph(browser, hospital, 0.5, `${out}/graph.png`);
  await live(browser, zwang, `${specs}/wall_align.yaml`, 7.4, `${out}/live.png`, `${folder}/live`);
  for (const [task, what] of runs) await useCase(browser, made(task, what), task, `${out}/case_${task}.webp`);
  await turning(browser, wall, `${out}/turning.webp`, `${folder}/frames`);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
