// The page of `zwang test`: all runs, the worst first; a click opens what happened in one.
import type { Cell, Expectation, MatrixData } from './data';
import { h, part } from './dom';
import { cell as td, table } from './tables';
import { seconds, withUnit } from './units';
import { way } from './way';

const percent = (share: number | null): string => (share === null ? '–' : `${(100 * share).toFixed(1)} %`);
const count = (n: number, thing: string): string => `${n} ${thing}${n === 1 ? '' : 's'}`;
const number = (value: number, unit: string): string => {
  const small = value !== 0 && Math.abs(value) < 1e-3;
  return small ? `${value.toExponential(1)} ${unit}`.trim() : withUnit(value, unit);
};

function reading(one: Expectation): string {
  const parts = [one.value === null ? '' : number(one.value, one.unit), one.margin === null ? '' : `margin ${percent(one.margin)}`].filter(Boolean);
  return parts.length ? `${parts.join(', ')} at ${seconds(one.time)}` : '';
}

function outcomeOf(cell: Cell): string {
  const robots = (cell.robots ?? []).map((one) => `, ${one.name} ${one.outcome}${one.because ? ` (${one.because})` : ''}`);
  return `${cell.outcome}${cell.because ? ` (${cell.because})` : ''}${robots.join('')}${cell.simulated > 0 ? ` after ${cell.simulated.toFixed(2)} s` : ''}`;
}

function expectations(cell: Cell): HTMLElement {
  return table(['expected', 'is', 'figure, margin', 'line'], cell.expectations.map((one) => h('tr', { class: one.held ? '' : 'broken' },
    td(one.text), one.held ? h('td', { class: 'sign' }, '✓ held') : h('td', {}, h('strong', {}, '✗ missed')), td(reading(one)), td(one.where))));
}

function more(shown: number, all: number): HTMLElement | false {
  return all > shown && h('p', { class: 'note' }, `and ${all - shown} more`);
}

function story(cell: Cell): HTMLElement {
  const { transitions, events, limits, counts } = cell.story;
  const [transitionCount, eventCount, limitCount] = counts as [number, number, number];
  return h('div', {},
    h('h3', {}, 'Transitions'),
    transitions.length ? h('ol', { class: 'steps' }, ...transitions.map(([time, from, to, why]) => h('li', {}, `${seconds(time)} ${from || 'start'} → ${to}: ${why}`))) : h('p', {}, 'None.'),
    more(transitions.length, transitionCount),
    h('h3', {}, 'Events'),
    events.length ? h('ul', { class: 'steps' }, ...events.map(([time, code, signal]) => h('li', {}, `${seconds(time)} ${code} ${signal}`))) : h('p', {}, 'None.'),
    more(events.length, eventCount),
    limits.length > 0 && h('h3', {}, 'Limits, the worst first'),
    limits.length > 0 && table(['column of the log', 'worst', 'limit', 'margin'], limits.map(([row, worst, limit, margin, unit, broken]) =>
      h('tr', { class: broken ? 'broken' : '' }, td(row), td(withUnit(worst, unit), 'figure'), td(withUnit(limit, unit), 'figure'),
        broken ? h('td', { class: 'figure' }, h('strong', {}, `✗ BROKEN ${withUnit(margin, unit)}`)) : td(withUnit(margin, unit), 'figure')))),
    more(limits.length, limitCount));
}

function detail(data: MatrixData, cell: Cell): HTMLElement {
  const picture = way(data, cell);
  const refused = cell.outcome === 'refused';
  return h('div', { class: 'detail' },
    h('p', { class: 'command' }, h('span', {}, refused ? 'Why it is refused:' : 'The whole page of this run:'), h('code', { tabindex: 0 }, cell.command.replace(refused ? ' --report' : '\0', ''))),
    h('div', {}, h('h3', {}, 'Expectations, the worst first'), expectations(cell), refused ? null : h('p', {}, `Motors: at ${percent(cell.torque)} of their torque at most.`)),
    h('div', {}, picture && h('figure', {}, picture, h('figcaption', {}, 'From above. Dashed: the base at the start. Objects stand where they are at the start.'))),
    refused ? null : story(cell));
}

class Row {
  readonly element: HTMLElement;
  private readonly head: HTMLElement;
  private body: HTMLElement | null = null;
  readonly words: string;

  constructor(private readonly data: MatrixData, readonly cell: Cell, readonly index: number) {
    const scenario = data.scenarios[cell.scenario]!;
    this.words = `${scenario.file} ${cell.name} ${cell.outcome} ${cell.because} ${cell.why}`.toLowerCase();
    this.head = h('button', { class: 'head', 'aria-expanded': 'false', onclick: () => this.toggle() },
      h('span', {}, h('strong', {}, cell.passed ? '✓ ok' : '✗ FAIL'), cell.name, h('br'), h('span', { class: 'file' }, scenario.file)),
      h('span', {}, outcomeOf(cell)), h('span', {}, cell.worst === null ? (cell.passed ? 'no margin' : 'missed') : `margin ${percent(cell.worst)}`));
    const missed = cell.expectations.filter((one) => !one.held).map((one) => h('p', { class: 'missed' }, `✗ missed: ${one.text}${reading(one) ? `: ${reading(one)}` : ''}`));
    this.element = h('li', { class: cell.passed ? 'good' : 'bad', id: `cell-${index}` }, this.head,
      !cell.passed && cell.why ? h('p', { class: 'why' }, `Why: ${cell.why}`) : null, ...missed);
  }

  toggle(): void {
    const isOpen = this.head.getAttribute('aria-expanded') !== 'true';
    this.head.setAttribute('aria-expanded', String(isOpen));
    this.body ??= detail(this.data, this.cell);
    if (isOpen) this.element.append(this.body);
    else this.body.remove();
    if (isOpen) history.replaceState(null, '', `#cell-${this.index}`);
  }
}

function scenarioTable(data: MatrixData, onFile: (file: string) => void): HTMLElement {
  const rows = data.scenarios.map((scenario, i) => {
    const cells = data.cells.filter((one) => one.scenario === i);
    const good = cells.filter((one) => one.passed).length;
    const margins = cells.flatMap((one) => (one.worst === null ? [] : [one.worst]));
    const isBad = !scenario.readable || good < cells.length;
    return { isBad, worst: margins.length ? Math.min(...margins) : Infinity, element: h('tr', { class: isBad ? 'broken' : '' },
      h('td', {}, h('button', { class: 'link', onclick: () => onFile(scenario.file) }, scenario.file)),
      h('td', {}, scenario.readable ? (isBad ? h('strong', {}, `✗ ${good} of ${cells.length}`) : `✓ ${good} of ${cells.length}`) : h('strong', {}, '✗ has errors')),
      td(margins.length ? percent(Math.min(...margins)) : '–', 'figure'), td(scenario.about)) };
  });
  rows.sort((a, b) => (a.isBad !== b.isBad ? (a.isBad ? -1 : 1) : a.worst - b.worst));
  return table(['scenario', 'as expected', 'least margin', 'about'], rows.map((one) => one.element));
}

export function matrixPage(data: MatrixData): void {
  const good = data.cells.filter((one) => one.passed).length;
  const unreadable = data.scenarios.filter((one) => !one.readable);
  const isBad = good < data.cells.length || unreadable.length > 0;
  const missing = data.runs - data.cells.length;
  const rows = data.cells.map((one, i) => new Row(data, one, i));
  const list = h('ol', { class: 'cells' }, ...rows.map((row) => row.element));
  const told = h('output', { 'aria-live': 'polite' });
  const search = h('input', { type: 'search', 'aria-label': 'Runs whose scenario, name, outcome or reason has these words', placeholder: 'words of a run', oninput: () => filter() });
  const failed = h('input', { type: 'checkbox', id: 'failed', onchange: () => filter() });
  function filter(): void {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      row.element.hidden = (failed.checked && row.cell.passed) || !words.every((word) => row.words.includes(word));
      shown += row.element.hidden ? 0 : 1;
    }
    told.textContent = `${shown} of ${count(rows.length, 'run')}`;
  }
  filter();
  const sentence = `${good} of ${count(data.cells.length, 'run')} as expected` +
    (missing > 0 ? `, ended before ${count(missing, 'more run')}` : '') +
    (unreadable.length ? `, and ${count(unreadable.length, 'file')} with errors` : '') + `, in ${data.seconds.toFixed(1)} s.`;
  // Runs that are still to come may be bad ones.
  const [sign, kind] = isBad ? ['✗', 'failed'] : missing > 0 ? ['?', 'cut'] : ['✓', 'done'];
  document.title = `zwang test: ${sentence}`;
  document.getElementById('page')!.append(
    h('header', { class: `verdict ${kind}` }, h('h1', {}, h('span', { 'aria-hidden': 'true' }, `${sign} `), 'zwang test'), h('p', { id: 'verdict' }, sentence)),
    h('main', { class: 'single' },
      unreadable.length > 0 && part('unreadable', 'Files with errors', ...unreadable.map((one) => h('pre', { tabindex: 0 }, one.diagnostics))),
      part('runs', 'Runs, the worst first', h('div', { class: 'filters' }, search, h('label', { for: 'failed' }, failed, ' failed alone'), told), list),
      part('scenarios', 'Scenarios', scenarioTable(data, (file) => {
        search.value = file;
        filter();
        document.getElementById('runs')!.scrollIntoView();
      }))));
  (window as unknown as { zwang: unknown }).zwang = { data };
  const asked = /^#cell-(\d+)$/.exec(location.hash);
  if (asked) {
    const row = rows[Number(asked[1])];
    row?.toggle();
    row?.element.scrollIntoView();
  }
}
