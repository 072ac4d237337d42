// Which task was active when, and which rows were at their limit meanwhile.
import type { Moments } from './clock';
import type { Run } from './data';
import { h } from './dom';
import { rowsAtLimit, type Span } from './limits';
import { seconds } from './units';

const mostRows = 12;

export function band(run: Run, clock: Moments): HTMLElement {
  // Samples that stay away let an event come after the last record.
  const percent = (time: number): string => `${Math.min(100, (100 * time) / run.duration)}%`;
  const bar = (span: Span, text: string, kind: string, shown = text): HTMLElement => {
    const button = h('button', { class: `bar ${kind}`, title: `${text}: ${seconds(span[0])} to ${seconds(span[1])}`, onclick: () => clock.show(span[0]) }, shown);
    button.style.left = percent(span[0]);
    button.style.width = percent(Math.max(span[1] - span[0], run.duration / 1000));
    return button;
  };
  const row = (name: string, bars: HTMLElement[]): HTMLElement =>
    h('div', { class: 'band-row' }, h('span', { class: 'band-name', title: name }, name), h('div', { class: 'band-bars' }, ...bars));
  const { tasks, begin, events } = run.data;
  const rows = [row('task', tasks.map((one, i) => bar([one.begin - begin, one.end - begin], one.task, i % 2 ? 'odd' : 'even')))];
  const saturated = rowsAtLimit(run);
  if (saturated.length) rows.push(h('div', { class: 'band-row band-head' }, 'at its limit:'));
  for (const one of saturated.slice(0, mostRows)) rows.push(row(one.name, one.spans.slice(0, 200).map((span) => bar(span, `${one.name} at its limit`, 'limit', ''))));
  if (events.length) rows.push(row('events', events.slice(0, 200).map((one) => bar([one.time - begin, one.time - begin], one.code, 'event'))));
  const needle = h('div', { class: 'needle' });
  const whole = h('div', { class: 'band' }, ...rows, h('div', { class: 'band-row needle-row', 'aria-hidden': 'true' }, h('span', { class: 'band-name' }), h('div', { class: 'band-bars' }, needle)));
  clock.onTime((time) => { needle.style.left = percent(time); });
  const more = saturated.length - mostRows;
  return h('div', {}, whole, more > 0 && h('p', { class: 'note' }, `and ${more} more rows that were at their limit for a shorter time`));
}
