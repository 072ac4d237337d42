// Charts of a study on canvases: how often a margin occurs, and the margin over what was drawn.
import type { StudyData } from './data';
import { inUnit } from './units';

export interface Colours { ink: string; line: string; held: string; missed: string }
interface Axis { low: number; high: number; isLog: boolean; text: (value: number) => string }
interface Point { x: number; y: number; held: boolean }
/** Points, or bars where `bars` is true: then x is the middle of a bar, and y how many. */
export interface Chart { caption: string; label: string; x: Axis; y: Axis; points: Point[]; bars: boolean }

const share = (value: number): string => `${+(100 * value).toPrecision(3)} %`;

function axis(values: number[], isLog: boolean, text: (value: number) => string): Axis {
  const low = Math.min(...range(values)), high = Math.max(...range(values));
  return low < high ? { low, high, isLog, text } : { low: low - 0.5, high: high + 0.5, isLog: false, text };
}
/** The least and the greatest: thousands of numbers are too many arguments for Math.min. */
const range = (values: number[]): [number, number] =>
  values.reduce<[number, number]>(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);

const most = 40;
export function margins(data: StudyData, expectation: number): Chart {
  const { held, margins: all } = data.points.expectations[expectation]!;
  const values = all.filter((value): value is number => value !== null);
  const x = axis(values, false, share);
  const width = (x.high - x.low) / most;
  const bars = Array.from({ length: most }, (_, i) => ({ x: x.low + (i + 0.5) * width, y: 0, held: true }));
  all.forEach((value, i) => {
    if (value === null) return;
    const bar = bars[Math.min(most - 1, Math.floor((value - x.low) / width))]!;
    bar.y += 1;
    if (!held[i]) bar.held = false;
  });
  const y = { low: 0, high: Math.max(...bars.map((bar) => bar.y)), isLog: false, text: (value: number) => String(Math.round(value)) };
  return { caption: 'cells over the margin', label: `Histogram of ${values.length} margins from ${share(x.low)} to ${share(x.high)}`, x, y, points: bars, bars: true };
}

export function overDraw(data: StudyData, expectation: number, index: number): Chart {
  const draw = data.draws[index]!;
  const { held, margins: all } = data.points.expectations[expectation]!;
  const text = (value: number): string => {
    const [shown, unit] = inUnit(value, draw.unit);
    return `${Number(shown.toPrecision(3))} ${unit}`.trim();
  };
  const points = all.flatMap((y, i) => (y === null ? [] : [{ x: data.points.drawn[index]![i]!, y, held: held[i] === 1 }]));
  const x = axis(points.map((point) => point.x), draw.is_log, text), y = axis(points.map((point) => point.y), false, share);
  return { caption: `margin over ${draw.name}`, label: `${points.length} margins over ${draw.name} from ${text(x.low)} to ${text(x.high)}`, x, y, points, bars: false };
}

/** From 0 to 1 along the axis. */
function along(axis: Axis, value: number): number {
  const scale = axis.isLog && axis.low > 0 ? Math.log : (one: number): number => one;
  return (scale(value) - scale(axis.low)) / (scale(axis.high) - scale(axis.low));
}

/** What was missed is a cross, or a hatched bar: never told by its colour alone. */
export function paint(canvas: HTMLCanvasElement, chart: Chart, colours: Colours): void {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (width === 0) return;
  [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
  const pen = canvas.getContext('2d')!;
  pen.scale(ratio, ratio);
  pen.font = '12px system-ui, sans-serif';
  const [left, right, top, bottom] = [58, width - 10, 8, height - 24];
  const px = (value: number): number => left + along(chart.x, value) * (right - left);
  const py = (value: number): number => bottom - along(chart.y, value) * (bottom - top);
  pen.strokeStyle = colours.line;
  pen.strokeRect(left, top, right - left, bottom - top);
  pen.fillStyle = colours.ink;
  pen.textAlign = 'left';
  pen.fillText(chart.x.text(chart.x.low), left, height - 7);
  pen.textAlign = 'right';
  pen.fillText(chart.x.text(chart.x.high), right, height - 7);
  pen.fillText(chart.y.text(chart.y.high), left - 6, top + 10);
  pen.fillText(chart.y.text(chart.y.low), left - 6, bottom);
  const half = (right - left) / most / 2 - 0.5;
  for (const point of chart.points) {
    pen.strokeStyle = pen.fillStyle = point.held ? colours.held : colours.missed;
    const [x, y] = [px(point.x), py(point.y)];
    if (chart.bars && point.held) pen.fillRect(x - half, y, 2 * half, bottom - y);
    else if (chart.bars) {
      pen.strokeRect(x - half, y, 2 * half, bottom - y);
      for (let stripe = y; stripe < bottom; stripe += 5) pen.strokeRect(x - half, stripe, 2 * half, 0.01);
    } else if (point.held) pen.fillRect(x - 1, y - 1, 2, 2);
    else {
      pen.beginPath();
      pen.moveTo(x - 3, y - 3);
      pen.lineTo(x + 3, y + 3);
      pen.moveTo(x - 3, y + 3);
      pen.lineTo(x + 3, y - 3);
      pen.stroke();
    }
  }
}
