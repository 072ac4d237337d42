// Which task was active when, and which rows were at their limit meanwhile.
import type { Moments } from './clock';
import type { Run } from './data';
import { h } from './dom';
import { seconds } from './units';

type Span = [number, number];
const mostRows = 12;

/** Where a column of 0 and 1 is 1. */
function spansOf(run: Run, name: string): Span[] {
  const spans: Span[] = [];
  const values = run.curve(name) ?? [];
  values.forEach((value, i) => {
    if (!(value > 0.5)) return;
    const begin = run.times[i]!;
    const end = run.times[i + 1] ?? run.duration;
    const last = spans.at(-1);
    if (last && begin - last[1] < run.duration / 600) last[1] = end;
    else spans.push([begin, end]);
  });
  return spans;
}

export function band(run: Run, clock: Moments): HTMLElement {
  const percent = (time: number): string => `${(100 * time) / run.duration}%`;
  const bar = (span: Span, text: string, kind: string): HTMLElement => {
    const button = h('button', { class: `bar ${kind}`, title: `${text}: ${seconds(span[0])} to ${seconds(span[1])}`, onclick: () => clock.show(span[0]) }, text);
    button.style.left = percent(span[0]);
    button.style.width = percent(Math.max(span[1] - span[0], run.duration / 1000));
    return button;
  };
  const row = (name: string, bars: HTMLElement[]): HTMLElement =>
    h('div', { class: 'band-row' }, h('span', { class: 'band-name', title: name }, name), h('div', { class: 'band-bars' }, ...bars));
  const { tasks, begin, events } = run.data;
  const rows = [row('task', tasks.map((one, i) => bar([one.begin - begin, one.end - begin], one.task, i % 2 ? 'odd' : 'even')))];
  const saturated = [...run.columns.keys()].filter((name) => name.endsWith('.saturated'))
    .map((name) => ({ name: name.slice(0, -'.saturated'.length), spans: spansOf(run, name) }))
    .filter((one) => one.spans.length > 0)
    .sort((a, b) => total(b.spans) - total(a.spans));
  for (const one of saturated.slice(0, mostRows)) rows.push(row(`${one.name} at its limit`, one.spans.slice(0, 200).map((span) => bar(span, '', 'limit'))));
  if (events.length) rows.push(row('events', events.slice(0, 200).map((one) => bar([one.time - begin, one.time - begin], one.code, 'event'))));
  const needle = h('div', { class: 'needle' });
  const whole = h('div', { class: 'band' }, ...rows, h('div', { class: 'band-row needle-row', 'aria-hidden': 'true' }, h('span', { class: 'band-name' }), h('div', { class: 'band-bars' }, needle)));
  clock.onTime((time) => { needle.style.left = percent(time); });
  const more = saturated.length - mostRows;
  return h('div', {}, whole, more > 0 && h('p', { class: 'note' }, `and ${more} more rows that were at their limit for a shorter time`));
}

const total = (spans: Span[]): number => spans.reduce((sum, [begin, end]) => sum + end - begin, 0);
