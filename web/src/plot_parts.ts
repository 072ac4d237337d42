// What charts have in common: axes, gaps, limits, the sample of a line.
import uPlot from 'uplot';
import { colour, dashes, ofStyle } from './colours';
import type { Run } from './data';
import { h } from './dom';

/** A limit while it holds. */
export interface Stretch { low: number | null; high: number | null; begin: number; end: number }
/** A curve with its limits, in the unit that is shown. */
export interface Drawn { values: Float32Array; bounds: Stretch[] }

export function axes(): uPlot.Axis[] {
  const axis = { stroke: ofStyle('--ink'), grid: { stroke: ofStyle('--grid'), width: 1 }, ticks: { stroke: ofStyle('--grid') } };
  return [{ ...axis, values: (_, ticks) => ticks.map((t) => `${t} s`) }, { ...axis, size: 62 }];
}

/** Of the curves, without the axes [px]; as uPlot knows it. */
export const widthOf = (plot: uPlot): number => plot.bbox.width / uPlot.pxRatio;

/** uPlot knows a blank as null alone. */
export const withGaps = (values: Float32Array): (number | null)[] => Array.from(values, (value) => (Number.isNaN(value) ? null : value));

/** The limits of a column, each while its task is active. */
export function whileActive(run: Run, column: string, factor: number): Stretch[] {
  const { tasks, begin } = run.data;
  const scaled = (value: number | null): number | null => (value === null ? null : value * factor);
  return (run.data.bounds ?? []).filter((bound) => bound.column === column).flatMap((bound) => {
    const times: [number, number][] = bound.task === null ? [[0, run.duration]]
      : tasks.filter((one) => one.task === bound.task).map((one) => [one.begin - begin, one.end - begin]);
    return times.map(([from, until]) => ({ low: scaled(bound.low), high: scaled(bound.high), begin: from, end: until }));
  });
}

/** The curves with the limits that are not far from them, and a tenth of room; rounding alone is a line. */
export function rangeOf(low: number | null, high: number | null, shown: Drawn[]): [number, number] {
  let [a, b] = [low ?? 0, high ?? 0];
  const near = 3 * Math.max(Math.abs(a), Math.abs(b));
  for (const value of shown.flatMap((one) => one.bounds.flatMap((bound) => [bound.low, bound.high]))) {
    if (value === null || Math.abs(value) > near) continue;
    [a, b] = [Math.min(a, value), Math.max(b, value)];
  }
  const room = Math.max(0.1 * (b - a), 0.01, 1e-4 * Math.abs(a));
  return [a - room, b + room];
}

/** Dashes of dots in the colour of the curve. */
export function drawBounds(plot: uPlot, shown: Drawn[]): void {
  const c = plot.ctx;
  c.save();
  c.beginPath();
  c.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
  c.clip();
  shown.forEach((one, i) => {
    c.strokeStyle = colour(i);
    c.lineWidth = 1.5 * devicePixelRatio;
    c.setLineDash([2 * devicePixelRatio, 4 * devicePixelRatio]);
    for (const bound of one.bounds) {
      for (const value of [bound.low, bound.high]) {
        // A line far outside of the picture keeps some browsers busy for ever.
        if (value === null || !(value >= plot.scales.y!.min! && value <= plot.scales.y!.max!)) continue;
        const y = plot.valToPos(value, 'y', true);
        c.beginPath();
        c.moveTo(plot.valToPos(bound.begin, 'x', true), y);
        c.lineTo(plot.valToPos(bound.end, 'x', true), y);
        c.stroke();
      }
    }
  });
  c.restore();
}

/** The line of a curve in a legend. */
export function lineSample(i: number): HTMLElement {
  const line = h('canvas', { width: 36, height: 8, 'aria-hidden': 'true' });
  const c = line.getContext('2d')!;
  c.strokeStyle = colour(i);
  c.lineWidth = 2;
  c.setLineDash(dashes[i % dashes.length]!);
  c.beginPath();
  c.moveTo(0, 4);
  c.lineTo(36, 4);
  c.stroke();
  return line;
}
