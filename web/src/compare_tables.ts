// What two runs do not have alike, in words and tables.
import type { Clock } from './clock';
import type { ColumnDifference, Comparison, FileDifference, Happenings, Limit, Run } from './data';
import { h } from './dom';
import { cell, table } from './tables';
import { seconds, withUnit } from './units';

interface Curves { has(name: string): boolean; show(name: string): void }
const mostColumns = 300;

const count = (n: number, thing: string): string => `${n} ${thing}${n === 1 ? '' : 's'}`;
const orDash = (value: string | null): string => (value === null || value === '' ? '–' : value);

function fileOf(file: FileDifference): HTMLElement {
  if (!file.first || !file.second)
    return h('p', {}, 'Only run ', h('b', {}, file.first ? 'A' : 'B'), ' reads ', h('code', {}, file.first || file.second), '.');
  const lines = (letter: string, all: string[], whole: number): HTMLElement[] => [
    ...all.map((line, i) => h('div', {}, `${letter} ${String(file.line + i).padStart(4)}  ${line}`)),
    ...(whole > all.length ? [h('div', {}, `${letter}       and ${count(whole - all.length, 'more line')}`)] : []),
    ...(whole === 0 ? [h('div', {}, `${letter}       (has none of these lines)`)] : []),
  ];
  const name = file.first === file.second ? [h('code', {}, file.first)] : [h('code', {}, file.first), ' of A, ', h('code', {}, file.second), ' of B'];
  return h('div', {}, h('p', {}, ...name, ` differs from line ${file.line} on:`),
    h('div', { class: 'lines', tabindex: 0 }, ...lines('A', file.first_lines, file.first_count), ...lines('B', file.second_lines, file.second_count)));
}

export function beforeTheStart({ facts, files, only_first, only_second, periods }: Comparison): HTMLElement {
  const columns = [[only_first, 'A'], [only_second, 'B']] as const;
  if (!facts.length && !files.length && !only_first.length && !only_second.length)
    return h('p', {}, 'Nothing: both have the same files, parameters, seed, start and versions.');
  return h('div', {},
    facts.length > 0 && table(['what', 'run A', 'run B'], facts.map((one) => h('tr', {}, cell(one.name), h('td', { class: 'exact' }, orDash(one.first)), h('td', { class: 'exact' }, orDash(one.second))))),
    ...files.map(fileOf),
    periods[0] !== periods[1] && h('p', {}, `The control periods are ${periods[0]} s and ${periods[1]} s: records are compared at the instants that both have.`),
    ...columns.filter(([names]) => names.length > 0).map(([names, letter]) =>
      h('details', {}, h('summary', {}, `${count(names.length, 'column')} of the log that run ${letter} alone has`), h('p', {}, h('code', {}, names.join(', '))))));
}

/** The least that can be said of how far the comparison reaches. */
function reach({ compared, until }: Comparison, runs: Run[]): string {
  const records = Math.min(...runs.map((run) => run.data.records));
  const longer = runs.findIndex((run) => run.duration > until + 1e-3);
  return `${count(compared, 'pair')} of records compared, up to ${seconds(until)}` +
    (compared < 0.9 * records ? `, of ${records} records of the shorter log: the others have no record of the same time beside them` : '') +
    (longer < 0 ? '.' : `; run ${'AB'[longer]} goes on for ${seconds(runs[longer]!.duration - until)}.`);
}

function sentence(one: ColumnDifference, alike: number): HTMLElement {
  const value = (text: string): HTMLElement => h('code', { class: 'exact' }, text === '' ? 'blank' : text);
  const unit = one.unit ? ` [${one.unit}]` : '';
  const source = one.input ? 'It is an input: what was sensed, or set, differs.'
    : alike > 0 ? `It was computed in a record that has ${count(alike, 'input')} unlike.` : 'No input differs until then: files, start or versions make it.';
  return h('p', { class: 'found' }, 'At ', h('b', {}, seconds(one.time)), ' ', h('code', {}, one.name), unit, ' is ', value(one.first), ' in A and ', value(one.second), ` in B. ${source}`);
}

export function firstDifference(comparison: Comparison, runs: Run[], clock: Clock, curves: Curves): HTMLElement {
  const { columns, compared } = comparison;
  if (compared === 0) return h('p', {}, 'No record of one run has the same time as one of the other.');
  if (!columns.length) return h('div', {}, h('p', { class: 'found' }, 'None: every value that both logs have is the same, bit by bit.'), h('p', { class: 'note' }, reach(comparison, runs)));
  const first = columns[0]!;
  const at = (time: number): HTMLElement => h('td', { class: 'figure' }, h('button', { class: 'link', onclick: () => clock.show(time) }, seconds(time)));
  const rows = columns.slice(0, mostColumns).map((one) => h('tr', {},
    h('td', {}, curves.has(one.name) ? h('button', { class: 'link', title: 'Show the curve', onclick: () => curves.show(one.name) }, one.name) : one.name),
    cell(one.input ? 'input' : 'computed'), at(one.time), h('td', { class: 'exact' }, one.first === '' ? 'blank' : one.first), h('td', { class: 'exact' }, one.second === '' ? 'blank' : one.second), cell(one.unit),
    cell(one.largest === null ? '–' : withUnit(one.largest, one.unit), 'figure'), one.largest === null ? cell('–', 'figure') : at(one.largest_time)));
  const inputs = columns.filter((one) => one.input && one.time === first.time).length;
  const more = columns.length - mostColumns;
  return h('div', {}, sentence(first, inputs),
    h('p', {}, h('button', { class: 'show', onclick: () => clock.show(first.time) }, 'Go to this moment')),
    h('p', { class: 'note' }, reach(comparison, runs), ` ${count(columns.length, 'column')} of the log differ, the first one first.`),
    h('div', { class: 'tall' }, table(['column of the log', 'kind', 'first at', 'A', 'B', 'unit', 'largest difference', 'at'], rows)),
    more > 0 && h('p', { class: 'note' }, `and ${more} more columns`));
}

export function happenings(both: Happenings, thing: string, clock: Clock): HTMLElement {
  const { first, second, counts, differs } = both;
  const length = Math.max(first.length, second.length);
  if (length === 0) return h('p', {}, `Neither run has an ${thing}.`);
  const side = (one: { time: number; what: string } | undefined): HTMLElement => (one
    ? h('p', {}, h('button', { class: 'link', onclick: () => clock.show(one.time) }, seconds(one.time)), ` ${one.what}`)
    : h('p', {}, '–'));
  const rows = Array.from({ length }, (_, i) => h('div', { class: differs !== null && i >= differs ? 'happening unlike' : 'happening' }, side(first[i]), side(second[i])));
  const words = differs === null ? `All ${count(counts[0]!, thing)} are alike.`
    : differs >= Math.min(counts[0]!, counts[1]!) ? `The first ${count(differs, thing)} are alike; then run ${counts[0]! > counts[1]! ? 'A' : 'B'} alone has more.`
      : `≠ The ${thing}s differ from number ${differs + 1} on.`;
  const hidden = Math.max(...counts) - length;
  return h('div', {}, h('p', { class: 'found' }, words),
    h('div', { class: 'happening' }, h('p', {}, h('b', { class: 'letter' }, 'A')), h('p', {}, h('b', { class: 'letter b' }, 'B'))), h('div', { class: 'tall', tabindex: 0 }, ...rows),
    hidden > 0 && h('p', { class: 'note' }, `and ${hidden} more`));
}

export function marginsOfBoth(runs: Run[]): HTMLElement {
  const limits = runs.map((run) => run.data.report?.limits ?? []);
  if (!limits[0]!.length && !limits[1]!.length) return h('p', { class: 'note' }, 'Neither log has a report at its end.');
  const share = (limit: Limit | undefined): number => (limit ? limit.margin / Math.max(Math.abs(limit.limit), 1e-9) : Infinity);
  // A row may have several limits: the worst one of a name counts.
  const worst = (all: Limit[], row: string): Limit | undefined => all.filter((one) => one.row === row).sort((a, b) => share(a) - share(b))[0];
  const names = [...new Set(limits.flat().map((one) => one.row))];
  const both = names.map((row) => limits.map((all) => worst(all, row))).sort((a, b) => Math.min(...a.map(share)) - Math.min(...b.map(share)));
  const figures = (one: Limit | undefined): HTMLElement[] => (one
    ? [cell(withUnit(one.worst, one.unit), 'figure'), cell(withUnit(one.limit, one.unit), 'figure'), h('td', { class: 'figure' }, one.broken ? h('strong', {}, `✗ BROKEN ${withUnit(one.margin, one.unit)}`) : withUnit(one.margin, one.unit))]
    : [cell('–', 'figure'), cell('–', 'figure'), cell('–', 'figure')]);
  return table(['column of the log', 'A: worst', 'limit', 'margin', 'B: worst', 'limit', 'margin'], both.map((pair) =>
    h('tr', { class: pair.some((one) => one?.broken) ? 'broken' : '' }, cell(pair[0]?.row ?? pair[1]!.row), ...figures(pair[0]), ...figures(pair[1]))));
}
