// The charts of a run and the files beside them: a click in one leads into the other.
import type { Clock } from './clock';
import type { Run } from './data';
import { h, part } from './dom';
import { Chart, kindsOf } from './plots';
import { Source } from './source';

export interface Curves {
  charts: Chart[];
  source: Source;
  /** Shows a line of a file. */
  onLine(file: number, line: number): void;
  /** Shows a curve, and its chart. */
  onCurve(name: string): void;
  element: HTMLElement;
}

const note = 'A drag zooms all charts, a double click shows all, a click goes to the time. Dotted: a limit, while its task is active.';

export function curvesOf(run: Run, clock: Clock): Curves {
  const charts: Chart[] = [];
  const onLine = (file: number, line: number): void => source.show(file, line);
  const onCurve = (name: string): void => {
    const chart = charts.find((one) => one.has(name));
    chart?.show(name);
    chart?.element.scrollIntoView({ block: 'center' });
  };
  const source = new Source(run, clock, onCurve);
  for (const kind of kindsOf(run)) charts.push(new Chart(run, kind, clock, charts, onLine));
  const element = part('curves', 'Curves', h('p', { class: 'note' }, note), ...charts.map((chart) => chart.element));
  return { charts, source, onLine, onCurve, element };
}
