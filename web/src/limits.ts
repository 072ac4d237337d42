// When a row was at its limit: of a driver its own column says so, of a range its bounds do.
import { indexAt, type Run } from './data';
import { whileActive } from './plot_parts';

export type Span = [number, number];
const nearLimit = 0.01;  // share of a range that is left

/** Whether less than a hundredth of the range is left; of a range without a second side, of 1 in SI. */
export function isNear(value: number, low: number | null, high: number | null): boolean {
  if (low === high) return false;
  const range = low !== null && high !== null ? high - low : 1;
  return Math.min(high === null ? Infinity : high - value, low === null ? Infinity : value - low) < nearLimit * range;
}

/** Spans that are nearer to each other than a screen can show are one. */
function joined(spans: Span[], next: Span, shortest: number): void {
  const last = spans.at(-1);
  if (last && next[0] - last[1] < shortest) last[1] = Math.max(last[1], next[1]);
  else spans.push(next);
}

/** Where a column of 0 and 1 is 1. */
export function spansOfFlag(run: Run, name: string): Span[] {
  const spans: Span[] = [];
  const values = run.curve(name) ?? [];
  values.forEach((value, i) => {
    if (value > 0.5) joined(spans, [run.times[i]!, run.times[i + 1] ?? run.duration], run.duration / 600);
  });
  return spans;
}

/** Where a column of a range is near an end of it, while its task is active. */
export function spansOfRange(run: Run, name: string): Span[] {
  const spans: Span[] = [];
  const values = run.curve(name);
  if (!values) return spans;
  for (const { low, high, begin, end } of whileActive(run, name, 1)) {
    for (let i = indexAt(run.times, begin); i < values.length && run.times[i]! < end; ++i) {
      if (run.times[i]! < begin || Number.isNaN(values[i]!) || !isNear(values[i]!, low, high)) continue;
      joined(spans, [run.times[i]!, Math.min(end, run.times[i + 1] ?? run.duration)], run.duration / 600);
    }
  }
  return spans.sort((a, b) => a[0] - b[0]);
}

const total = (spans: Span[]): number => spans.reduce((sum, [begin, end]) => sum + end - begin, 0);

/** All rows that were at a limit, those first that were so for the longest time. A driver's force has its own flag. */
export function rowsAtLimit(run: Run): { name: string; spans: Span[] }[] {
  const flags = [...run.columns.keys()].filter((name) => name.endsWith('.saturated'));
  const told = new Set(flags.map((name) => name.replace(/\.saturated$/, '.nu')));
  const ranges = new Set((run.data.bounds ?? []).map((bound) => bound.column).filter((name) => !told.has(name)));
  return [
    ...flags.map((name) => ({ name: name.replace(/\.saturated$/, ''), spans: spansOfFlag(run, name) })),
    ...[...ranges].map((name) => ({ name, spans: spansOfRange(run, name) })),
  ].filter((one) => one.spans.length > 0).sort((a, b) => total(b.spans) - total(a.spans));
}
