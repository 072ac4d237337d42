// Why, margins, events and facts, as tables.
import type { Moments } from './clock';
import type { Exit, Limit, Run, Term } from './data';
import { h } from './dom';
import { seconds, withUnit } from './units';

type OnLine = (file: number, line: number) => void;

/** In a narrow place each row is a block, in which the cells have the names of their columns; roles keep it a table. */
export function table(names: string[], rows: HTMLElement[]): HTMLElement {
  for (const row of rows) {
    row.setAttribute('role', 'row');
    [...row.children].forEach((one, i) => {
      one.setAttribute('role', 'cell');
      if (i > 0 && one.textContent) one.setAttribute('data-name', names[i] ?? '');
    });
  }
  return h('div', { class: 'scroll', tabindex: 0 }, h('table', { role: 'table', class: 'fits' },
    h('thead', { role: 'rowgroup' }, h('tr', { role: 'row' }, ...names.map((name) => h('th', { scope: 'col', role: 'columnheader' }, name)))),
    h('tbody', { role: 'rowgroup' }, ...rows)));
}
export const cell = (text: string, kind = ''): HTMLElement => h('td', { class: kind }, text);

/** `wall_align.yaml:22` as a way to the line. */
function place(run: Run, where: string, onLine: OnLine): HTMLElement {
  const [file, line] = [where.slice(0, where.lastIndexOf(':')), Number(where.slice(where.lastIndexOf(':') + 1))];
  const index = run.data.files.findIndex((one) => one.path.split('/').at(-1) === file);
  if (index < 0) return cell(where);
  return h('td', {}, h('button', { class: 'link', onclick: () => onLine(index, line) }, where));
}

function reading(term: Term): string {
  // A log of zwang before it had the words has their figures alone.
  const signals = (term.signals ?? []).map((s) => s.words ?? `\`${s.name}\` is ${withUnit(s.age, 's')} old`);
  const stood = term.stood ? ` for at least ${withUnit(term.stood, 's')}` : '';
  return [term.value === null ? '' : withUnit(term.value, term.unit) + stood, ...signals, term.because ?? ''].filter(Boolean).join(', ');
}

const signs: Record<string, string> = { true: '✓ true', false: '✗ false', unknown: '? unknown' };

export function why(run: Run, onLine: OnLine): HTMLElement | null {
  const reason = run.data.report?.why;
  if (!reason || !reason.exits.length) return null;
  const task = run.data.facts['task']?.split('/').at(-1) ?? '';
  const rows = reason.exits.flatMap((exit: Exit) => [
    h('tr', { class: 'exit' }, cell(exit.when), cell(signs[exit.is] ?? exit.is), cell(`true ${(exit.times ?? 0) > 1 ? `${exit.times} times, ` : ''}for ${withUnit(exit.longest, 's')} at most, needed ${withUnit(exit.for, 's')}`),
      cell(`→ ${exit.to}`), exit.line ? place(run, `${task}:${exit.line}`, onLine) : cell('')),
    ...exit.terms.map((term) => h('tr', { class: term.holds_back ? 'term holds' : 'term' }, cell(term.text), cell(signs[term.is] ?? term.is), cell(reading(term)), cell(''), cell(''))),
  ]);
  return h('div', {}, h('p', {}, `What `, h('code', {}, reason.task), ` waited for, with the last values:`), table(['exit and its terms', 'is', 'reading', 'leads to', 'line'], rows));
}

export function warnings(run: Run, onLine: OnLine): HTMLElement | null {
  const all = run.data.warnings ?? [];
  if (!all.length) return null;
  return h('ul', { class: 'warnings' }, ...all.map((one) => h('li', {}, h('strong', {}, `⚠ ${one.code} `), `${one.message} `,
    run.data.files[one.file] && h('button', { class: 'link', onclick: () => onLine(one.file, one.line) }, `${run.data.files[one.file]!.path.split('/').at(-1)}:${one.line}`),
    one.help && h('span', { class: 'help' }, `Instead: ${one.help}`))));
}

export function margins(run: Run, clock: Moments, onLine: OnLine, onCurve: (name: string) => void): HTMLElement {
  void clock;
  const limits = run.data.report?.limits;
  if (!limits) return h('p', { class: 'note' }, 'The log has no margins at its end: the run was cut, or an older zwang drove it.');
  const share = (limit: Limit): number => limit.margin / Math.max(Math.abs(limit.limit), 1e-9);
  const rows = [...limits].sort((a, b) => share(a) - share(b)).map((limit) => {
    const left = Math.min(1, Math.max(0, share(limit)));
    const meter = h('meter', { min: 0, max: 1, value: left, 'aria-hidden': 'true' });
    return h('tr', { class: limit.broken ? 'broken' : '' },
      h('td', {}, run.curve(limit.row) ? h('button', { class: 'link', title: 'Show the curve', onclick: () => onCurve(limit.row) }, limit.row) : limit.row),
      cell(withUnit(limit.worst, limit.unit), 'figure'), cell(withUnit(limit.limit, limit.unit), 'figure'), cell(withUnit(limit.margin, limit.unit), 'figure'),
      h('td', {}, limit.broken ? h('strong', {}, '✗ BROKEN') : limit.margin < 0.01 * Math.abs(limit.limit) ? 'at its limit' : meter), place(run, limit.where, onLine));
  });
  return table(['column of the log', 'worst', 'limit', 'margin', 'left', 'line'], rows);
}

export function events(run: Run, clock: Moments): HTMLElement {
  const all = run.data.report?.events ?? run.data.events;
  if (!all.length) return h('p', {}, 'None of the guard. The first line says what the robot met.');
  return table(['time', 'event', 'signal', 'value'], all.map((one) => h('tr', {},
    h('td', {}, h('button', { class: 'link', onclick: () => clock.show(one.time - run.data.begin) }, seconds(one.time - run.data.begin))),
    cell(one.code), cell(one.signal), cell(one.value === null || one.value === undefined ? '–' : String(Number(one.value.toPrecision(5))), 'figure'))));
}

export function facts(run: Run): HTMLElement {
  const rows: [string, string][] = [...Object.entries(run.data.facts),
    ['records', `${run.data.records}${run.data.damage.length ? ', damaged' : ''}`],
    ['points', run.data.curves.records_a_bucket > 1
      ? `${run.data.curves.count}; two of them are the least and the largest of ${run.data.curves.records_a_bucket} records` : `${run.data.curves.count}, every record`]];
  return factList(rows);
}

export function factList(rows: [string, string][]): HTMLElement {
  return h('dl', { class: 'facts' }, ...rows.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
}
