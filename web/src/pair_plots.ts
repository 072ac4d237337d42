// Each quantity of two runs on one axis: run A solid, run B dashed.
import uPlot from 'uplot';
import type { Clock } from './clock';
import { colour, dashes, onScheme } from './colours';
import { indexAt, type Run } from './data';
import { h, write } from './dom';
import { axes, drawBounds, lineSample, rangeOf, whileActive, widthOf, withGaps, type Drawn } from './plot_parts';
import { inUnit, withUnit } from './units';

export const letters = ['A', 'B'];

interface Curve extends Drawn { run: Run; letter: string; i: number }

export class PairChart {
  readonly element: HTMLElement;
  private readonly place = h('div', { class: 'plot' });
  private readonly legend = h('ul', { class: 'legend' });
  private readonly needle = h('div', { class: 'needle' });
  private readonly curves: Curve[] = [];
  private readonly unit: string;
  private plot: uPlot | null = null;
  private isZooming = false;

  constructor(runs: Run[], readonly name: string, private readonly clock: Clock, private readonly charts: PairChart[], onRemove: () => void) {
    const column = runs.map((run) => run.columns.get(name)).find((one) => one !== undefined);
    const [factor, unit] = inUnit(1, column?.unit ?? '');
    this.unit = unit;
    runs.forEach((run, i) => {
      const raw = run.curve(name);
      if (raw) this.curves.push({ run, i, letter: letters[i]!, values: factor === 1 ? raw : raw.map((value) => value * factor), bounds: whileActive(run, name, factor) });
    });
    const alone = this.curves.length === 1 ? `, in run ${this.curves[0]!.letter} alone` : '';
    this.element = h('div', { class: 'chart', 'data-pair': name },
      h('h3', {}, h('code', {}, name), unit ? ` [${unit}]` : '', alone, h('button', { class: 'remove', 'aria-label': `Hide ${name}`, onclick: onRemove }, '×')), this.place, this.legend);
    this.legend.replaceChildren(...this.curves.map((one) => h('li', {}, lineSample(one.i), h('span', {}, `run ${one.letter}`), h('output', { 'data-curve': `${one.letter} ${name}` }))));
    this.build();
    clock.onTime((time) => this.point(time));
    onScheme(() => {
      this.build();
      this.legend.querySelectorAll('canvas').forEach((line, k) => line.replaceWith(lineSample(this.curves[k]!.i)));
    });
    new ResizeObserver(() => this.resize()).observe(this.place);
  }

  private build(): void {
    this.plot?.destroy();
    // The runs have instants of their own: what one lacks at an instant of the other is no gap.
    const data = uPlot.join(this.curves.map((one) => [Array.from(one.run.times), withGaps(one.values)] as uPlot.AlignedData));
    this.plot = new uPlot({
      width: Math.max(200, this.place.clientWidth || 500), height: 170,
      legend: { show: false },
      cursor: { sync: { key: 'pair' }, drag: { x: true, y: false } },
      scales: { x: { time: false }, y: { range: (_, low, high) => rangeOf(low, high, this.curves) } },
      axes: axes(),
      series: [{}, ...this.curves.map((one): uPlot.Series => ({ label: one.letter, stroke: colour(one.i), width: one.i ? 2 : 1.5, dash: dashes[one.i]!, points: { show: false }, spanGaps: false }))],
      hooks: {
        draw: [(plot) => drawBounds(plot, this.curves)],
        setScale: [(plot, key) => { if (key === 'x') this.zoomOthers(plot); }],
        ready: [(plot) => {
          plot.over.append(this.needle);
          plot.over.addEventListener('click', (event) => this.clock.show(plot.posToVal(event.offsetX, 'x')));
        }],
      },
    }, data, this.place);
    this.point(this.clock.time);
  }

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
    if (this.plot && width > 0 && Math.abs(this.plot.width - width) > 1) this.plot.setSize({ width, height: 170 });
    this.point(this.clock.time);
  }

  private point(time: number): void {
    if (!this.plot) return;
    const x = this.plot.valToPos(time, 'x');
    this.needle.hidden = !(x >= 0 && x <= widthOf(this.plot));
    this.needle.style.transform = `translateX(${x}px)`;
    this.legend.querySelectorAll('output').forEach((output, k) => {
      const one = this.curves[k]!;
      write(output, time > one.run.duration ? 'over' : withUnit(one.values[indexAt(one.run.times, time)], this.unit));
    });
  }
}
