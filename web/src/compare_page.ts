// The page of two runs: where they part, and both beside each other.
import { Clock } from './clock';
import { beforeTheStart, firstDifference, happenings, marginsOfBoth } from './compare_tables';
import { controls } from './controls';
import { taskAt, type ComparisonData, type Run } from './data';
import { h, part } from './dom';
import { letters, PairChart } from './pair_plots';
import { kindsOf } from './plots';
import { symbols } from './run_page';
import { TopView, type Viewed } from './top';
import { seconds } from './units';

const mostAtFirst = 10;

export const letterOf = (i: number): HTMLElement => h('b', { class: i ? 'letter b' : 'letter' }, letters[i]!);

function verdict(run: Run, path: string, i: number): HTMLElement {
  const outcome = run.data.report?.outcome ?? 'cut';
  const sentence = run.data.report?.verdict ?? `The log ends after ${seconds(run.duration)} without an outcome.`;
  return h('header', { class: `verdict ${outcome}` },
    h('h1', {}, letterOf(i), ' ', h('span', { 'aria-hidden': 'true' }, `${symbols[outcome] ?? '?'} `), run.data.facts['task']?.split('/').at(-1) ?? run.data.log),
    h('p', { class: 'path' }, path),
    h('p', { id: `verdict-${letters[i]}` }, sentence),
    run.data.damage.length > 0 && h('p', { class: 'note' }, `The log is damaged: ${run.data.damage.join('; ')}`));
}

/** What differs first among the computed, then what a page of either run shows first. */
function quantities(data: ComparisonData, runs: Run[]): string[] {
  const has = (name: string): boolean => runs.some((run) => run.columns.has(name));
  const parted = data.comparison.columns.filter((one) => !one.input && has(one.name)).slice(0, 2).map((one) => one.name);
  const usual = runs.flatMap((run) => kindsOf(run).flatMap((kind) => kind.first.slice(0, 3)));
  return [...new Set([...parted, ...usual])].slice(0, mostAtFirst);
}

class Charts {
  readonly element: HTMLElement;
  private readonly list = h('div', { class: 'pairs' });
  private readonly picker: HTMLSelectElement;
  private readonly charts: PairChart[] = [];
  private readonly all: string[];

  constructor(private readonly runs: Run[], private readonly clock: Clock, first: string[]) {
    this.all = [...new Set(runs.flatMap((run) => [...run.columns.keys()]))];
    this.picker = h('select', { 'aria-label': 'Add a curve', onchange: () => { if (this.picker.value) this.show(this.picker.value); } });
    this.element = h('div', {}, this.list, h('div', { class: 'chart' }, this.picker));
    for (const name of first) this.add(name);
    this.fillPicker();
  }

  private add(name: string): PairChart {
    const chart: PairChart = new PairChart(this.runs, name, this.clock, this.charts, () => {
      this.charts.splice(this.charts.indexOf(chart), 1);
      chart.element.remove();
      this.fillPicker();
    });
    this.charts.push(chart);
    this.list.append(chart.element);
    return chart;
  }

  private fillPicker(): void {
    const left = this.all.filter((name) => !this.charts.some((one) => one.name === name));
    this.picker.replaceChildren(h('option', { value: '' }, `add one of ${left.length} more quantities`), ...left.map((name) => h('option', { value: name }, name)));
    this.picker.hidden = left.length === 0;
  }

  has = (name: string): boolean => this.all.includes(name);

  show(name: string): void {
    const chart = this.charts.find((one) => one.name === name) ?? this.add(name);
    this.fillPicker();
    chart.element.scrollIntoView({ block: 'center' });
  }
}

export function comparePage(data: ComparisonData, a: Run, b: Run): void {
  const runs = [a, b];
  const clock = new Clock(Math.max(a.duration, b.duration));
  const viewed = runs.flatMap((run, i): Viewed[] => (run.data.world ? [{ run, world: run.data.world, letter: letters[i]! }] : []));
  const top = viewed.length ? new TopView(viewed, clock) : null;
  const charts = new Charts(runs, clock, quantities(data, runs));
  const task = (time: number): string =>
    runs.map((run, i) => `${letters[i]} ${time > run.duration ? 'over' : taskAt(run, time)}`).join(', ');
  document.title = `${data.names[0]} and ${data.names[1]}`;
  document.getElementById('page')!.append(
    h('div', { class: 'both' }, verdict(a, data.names[0]!, 0), verdict(b, data.names[1]!, 1)),
    controls(clock, task, top ? [top] : []),
    h('main', { class: 'single' }, h('div', { class: 'wide' },
      part('before', 'What differs before the start', beforeTheStart(data.comparison)),
      part('first', 'The first difference', firstDifference(data.comparison, runs, clock, charts)),
      part('transitions', 'Transitions', happenings(data.comparison.transitions, 'transition', clock)),
      part('events', 'Events', happenings(data.comparison.events, 'event', clock)),
      part('views', 'Where', top ? top.element : h('p', { class: 'note' }, 'The files of these runs do not load any more: no view.')),
      part('curves', 'Curves', h('p', { class: 'note' }, 'Run A is solid, run B is dashed. A drag zooms all charts, a double click shows all, a click goes to the time. Dotted: a limit, while its task is active.'), charts.element),
      part('margins', 'Margins, worst first', marginsOfBoth(runs)))));
  (window as unknown as { zwang: unknown }).zwang = { clock, runs, top, comparison: data.comparison };
  clock.show(0);
}
