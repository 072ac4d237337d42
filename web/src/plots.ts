// The curves of the run on one axis of time, with the limits drawn in.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import type { Clock } from './clock';
import { colour, dashes, onScheme } from './colours';
import type { Run } from './data';
import { indexAt } from './data';
import { h, write } from './dom';
import { axes, drawBounds, lineSample, rangeOf, whileActive, widthOf, withGaps, type Drawn } from './plot_parts';
import { inUnit, withUnit } from './units';

interface Shown extends Drawn { name: string; unit: string }

/** The end of the axis of time. A run that has just begun has one moment alone. */
const endOf = (begin: number, end: number): number => Math.max(end, begin + 1e-3);

/** A chart of one kind of curves. `all`: what can be shown; `first`: what is shown when the page opens. */
export interface Kind { id: string; title: string; unit: string; all: string[]; first: string[] }

export class Chart {
  readonly element: HTMLElement;
  private readonly place = h('div', { class: 'plot' });
  private readonly legend = h('ul', { class: 'legend' });
  private readonly picker: HTMLSelectElement;
  private readonly needle = h('div', { class: 'needle' });
  private plot: uPlot | null = null;
  private shown: Shown[] = [];

  constructor(
    private readonly run: Run, readonly kind: Kind, private readonly clock: Clock, private readonly charts: Chart[],
    private readonly onLine: (file: number, line: number) => void,
  ) {
    this.picker = h('select', { 'aria-label': `Add a curve to ${kind.title}`, onchange: () => this.pick() });
    this.element = h('div', { class: 'chart', id: `chart-${kind.id}` },
      h('h3', {}, kind.title), this.place, this.legend, this.picker);
    for (const name of kind.first) this.add(name);
    this.rebuild();
    clock.onTime((time) => this.point(time));
    onScheme(() => this.rebuild());
    new ResizeObserver(() => this.resize()).observe(this.place);
  }

  has(name: string): boolean {
    return this.kind.all.includes(name);
  }

  show(name: string): void {
    this.add(name);
    this.rebuild();
  }

  /** The run has grown. Who has zoomed keeps the piece. */
  grow(): void {
    const [old, scale] = [this.plot?.data[0], this.plot?.scales.x];
    const isWhole = !old?.length || (scale?.min === old[0] && scale?.max === endOf(old[0]!, old.at(-1)!));
    const names = this.shown.map((one) => one.name);
    this.shown = [];
    for (const name of names) this.add(name);
    this.plot?.setData(this.dataOf(), isWhole);
    if (!isWhole) this.plot?.redraw();
    this.point(this.clock.time);
  }

  private dataOf(): uPlot.AlignedData {
    return [Array.from(this.run.times), ...this.shown.map((one) => withGaps(one.values))];
  }

  private add(name: string): void {
    if (this.shown.some((one) => one.name === name)) return;
    const raw = this.run.curve(name);
    const column = this.run.columns.get(name);
    if (!raw || !column) return;
    const effort = this.kind.id === 'torque' ? this.effortOf(name) : null;
    const unit = effort ? '%' : column.unit;
    const factor = effort ? 100 / effort : inUnit(1, unit)[0];
    const values = factor === 1 ? raw : raw.map((value) => value * factor);
    this.shown.push({ name, values, unit, bounds: whileActive(this.run, name, factor) });
  }

  private effortOf(name: string): number | null {
    const body = this.run.data.world?.robot.bodies.find((one) => `${one.joint}.tau` === name);
    return body?.effort ?? null;
  }

  private pick(): void {
    if (this.picker.value) this.show(this.picker.value);
  }

  private rebuild(): void {
    this.plot?.destroy();
    const left = this.kind.all.filter((name) => !this.shown.some((one) => one.name === name));
    this.picker.replaceChildren(h('option', { value: '' }, left.length ? `add one of ${left.length} more curves` : 'all curves are shown'),
      ...left.map((name) => h('option', { value: name }, name)));
    this.picker.hidden = left.length === 0;
    this.drawLegend();
    const options: uPlot.Options = {
      width: Math.max(200, this.place.clientWidth || 600), height: 200,
      legend: { show: false },
      cursor: { sync: { key: 'run' }, drag: { x: true, y: false } },
      scales: { x: { time: false, range: (_, low, high) => [low, endOf(low, high)] }, y: { range: (_, low, high) => rangeOf(low, high, this.shown) } },
      axes: axes(),
      series: [{}, ...this.shown.map((one, i): uPlot.Series => ({
        label: one.name, stroke: colour(i), width: 1.5, dash: dashes[i % dashes.length]!, points: { show: false }, spanGaps: false,
      }))],
      hooks: {
        draw: [(plot) => drawBounds(plot, this.shown), () => this.point(this.clock.time)],
        setScale: [(plot, key) => { if (key === 'x') this.zoomOthers(plot); }],
        ready: [(plot) => {
          plot.over.append(this.needle);
          plot.over.addEventListener('click', (event) => this.clock.show(plot.posToVal(event.offsetX, 'x')));
        }],
      },
    };
    this.plot = new uPlot(options, this.dataOf(), this.place);
    this.point(this.clock.time);
  }

  private drawLegend(): void {
    this.legend.replaceChildren(...this.shown.map((one, i) => {
      const column = this.run.columns.get(one.name)!;
      const hasLine = column.file >= 0 && column.line > 0;
      return h('li', {}, lineSample(i),
        hasLine ? h('button', { class: 'link', title: 'Show its line', onclick: () => this.onLine(column.file, column.line) }, one.name) : h('span', {}, one.name),
        h('output', { 'data-curve': one.name }),
        h('button', { class: 'remove', 'aria-label': `Hide ${one.name}`, onclick: () => this.remove(one.name) }, '×'));
    }));
  }

  private remove(name: string): void {
    this.shown = this.shown.filter((one) => one.name !== name);
    this.rebuild();
  }

  private isZooming = false;
  private zoomOthers(plot: uPlot): void {
    const { min, max } = plot.scales.x!;
    if (this.isZooming || min === undefined || max === undefined || min === null || max === null) return;
    for (const chart of this.charts) {
      if (chart === this || !chart.plot) continue;
      const now = chart.plot.scales.x!;
      if (now.min === min && now.max === max) continue;
      chart.isZooming = true;
      chart.plot.setScale('x', { min, max });
      chart.isZooming = false;
    }
  }

  private resize(): void {
    const width = this.place.clientWidth;
    if (this.plot && width > 0 && Math.abs(this.plot.width - width) > 1) this.plot.setSize({ width, height: 200 });
    this.point(this.clock.time);
  }

  private point(time: number): void {
    if (!this.plot) return;
    const x = this.plot.valToPos(time, 'x');
    this.needle.hidden = !(x >= 0 && x <= widthOf(this.plot));
    this.needle.style.transform = `translateX(${x}px)`;
    const i = indexAt(this.run.times, time);
    this.legend.querySelectorAll('output').forEach((output, k) => {
      const one = this.shown[k]!;
      const [, unit] = inUnit(1, one.unit);
      write(output, withUnit(one.values[i], unit));
    });
  }
}

/** The charts of a run, with what matters first. */
export function kindsOf(run: Run): Kind[] {
  const names = [...run.columns.keys()];
  const ending = (...ends: string[]): string[] => names.filter((name) => ends.some((end) => name.endsWith(end)));
  // At the begin of a live run nobody knows yet which curves will matter.
  const isNew = run.data.report === null && run.times.length <= 2;
  const largest = (name: string): number => isNew ? 1 : run.curve(name)?.reduce((most, v) => (Math.abs(v) > most ? Math.abs(v) : most), 0) ?? 0;
  const byUnit = (unit: string): string[] => names.filter((name) => run.columns.get(name)!.unit === unit);
  const inTask = new Set([...run.data.tasks.map((one) => one.task), ...(isNew ? [run.data.graph?.start.replace(/^task /, '') ?? ''] : [])]);
  const isTold = (name: string): boolean => inTask.has(name.split('.')[0]!) || name.startsWith('always.');
  const truth = names.filter((name) => name.startsWith('truth.') && name.endsWith('.force') && largest(name) > 0);
  const asked = ending('.nu', '.sum').filter((name) => run.columns.get(name)!.unit === 'N' && isTold(name) && largest(name) > 0);
  const bounded = new Set((run.data.bounds ?? []).map((bound) => bound.column));
  const speeds = ending('.velocity').filter((name) => run.columns.get(name)!.unit === 'm/s' && isTold(name) && bounded.has(name));
  const efforts = new Set((run.data.world?.robot.bodies ?? []).filter((b) => b.effort).map((b) => `${b.joint}.tau`));
  const torques = ending('.tau').filter((name) => efforts.has(name));
  const ages = names.filter((name) => name.startsWith('signal.') && name.endsWith('.age'));
  const kinds: Kind[] = [
    { id: 'force', title: 'Force [N]: what the plant measured beside what was asked', unit: 'N', all: byUnit('N'), first: [...truth, ...asked].slice(0, 6) },
    { id: 'speed', title: 'Speed [m/s]', unit: 'm/s', all: byUnit('m/s'), first: ['base.vx', 'base.vy', ...speeds].slice(0, 5) },
    { id: 'torque', title: 'Share of each motor’s torque [%]', unit: '%', all: torques, first: torques.slice(0, 8) },
    { id: 'age', title: 'Age of the signals [s], and whether they are valid (1)', unit: 's', all: names.filter((n) => n.startsWith('signal.')), first: ages.slice(0, 6) },
    { id: 'other', title: 'Everything else', unit: '', all: names.filter((n) => !['N', 'm/s'].includes(run.columns.get(n)!.unit) && !torques.includes(n) && !n.startsWith('signal.')), first: ['base.wz'] },
  ];
  return kinds.filter((kind) => kind.all.length > 0);
}
