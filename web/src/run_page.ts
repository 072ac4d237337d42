// The page of one run.
import { band } from './band';
import { Clock } from './clock';
import { controls } from './controls';
import { curvesOf } from './curves';
import { taskAt, type Run } from './data';
import { h, part } from './dom';
import { graph } from './graph';
import { SpaceView } from './space';
import { events, facts, margins, warnings, why } from './tables';
import { TopView } from './top';

export const symbols: Record<string, string> = { done: '✓', failed: '✗', stopped: '■', fallen: '✗', diverged: '✗' };

function verdict(run: Run): HTMLElement {
  const { report, facts: known, log, damage } = run.data;
  const outcome = report?.outcome ?? 'cut';
  const name = known['task']?.split('/').at(-1) ?? log;
  document.title = `${name}: ${outcome}`;
  const sentence = report?.verdict ?? `The log ends after ${run.duration.toFixed(3)} s without an outcome.`;
  return h('header', { class: `verdict ${outcome}` },
    h('h1', {}, h('span', { 'aria-hidden': 'true' }, `${symbols[outcome] ?? '?'} `), name),
    h('p', { id: 'verdict' }, sentence),
    damage.length > 0 && h('p', { class: 'note' }, `The log is damaged: ${damage.join('; ')}`));
}

/** A run that is done is shown from its begin; another one at the moment that decided its end. */
function firstMoment(run: Run): number {
  const report = run.data.report;
  if (!report || report.outcome === 'done') return 0;
  return report.why ? report.why.time - run.data.begin : run.duration;
}

export function runPage(run: Run): void {
  const clock = new Clock(run.duration);
  const { source, onLine, onCurve, element: curves } = curvesOf(run, clock);
  const world = run.data.world;
  const top = world && new TopView([{ run, world }], clock);
  const space = world && new SpaceView(run, world, clock);
  const reason = why(run, onLine);
  const told = warnings(run, onLine);
  const views = [top, space].filter((view) => view !== null);
  document.getElementById('page')!.append(
    verdict(run),
    controls(clock, (time) => taskAt(run, time), views),
    h('main', {},
      h('div', { class: 'wide' },
        reason && part('why', 'Why', reason),
        told && part('warnings', 'Told before the run', told),
        part('views', 'Where', top && space ? h('div', { class: 'views' }, top.element, space.element) : h('p', { class: 'note' }, 'The files of this run do not load any more: no view.')),
        part('band', 'Tasks over time', band(run, clock)),
        curves,
        part('margins', 'Margins, worst first', margins(run, clock, onLine, onCurve)),
        part('graph', 'Tasks', graph(run, clock)),
        part('events', 'Events', events(run, clock)),
        part('facts', 'Parameters, seed, versions', facts(run))),
      h('aside', { 'aria-label': 'Files' }, part('source', 'Files', source.element))));
  (window as unknown as { zwang: unknown }).zwang = { clock, run, top };
  clock.show(firstMoment(run));
  setTimeout(() => space?.start(), 50);
}
