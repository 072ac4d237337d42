// The files of the run: a row lights up where it is at its limit, a line shows its curve.
import type { Clock } from './clock';
import { indexAt, taskAt, type Run } from './data';
import { h, write } from './dom';
import { isNear } from './limits';

interface Line { element: HTMLElement; mark: HTMLElement; columns: string[] }

export class Source {
  readonly element: HTMLElement;
  private readonly lines = new Map<string, Line>();
  private readonly panes: HTMLElement[] = [];
  private readonly tabs: HTMLButtonElement[] = [];
  private watched: Line[] = [];

  constructor(private readonly run: Run, clock: Clock, onCurve: (name: string) => void) {
    run.data.files.forEach((file, index) => {
      const name = file.path.split('/').at(-1)!;
      this.tabs.push(h('button', { role: 'tab', id: `tab-${index}`, 'aria-controls': `file-${index}`, onclick: () => this.open(index) }, name));
      this.panes.push(this.pane(index, file.text, onCurve));
    });
    const strip = h('div', { class: 'tabs', role: 'tablist', 'aria-label': 'Files of the run', onkeydown: (event: KeyboardEvent) => this.onKey(event) }, ...this.tabs);
    this.element = h('div', { class: 'source' }, strip, ...this.panes);
    this.open(0);
    this.watched = [...this.lines.values()].filter((line) => line.columns.length > 0);
    clock.onTime((time) => this.light(time));
  }

  private pane(index: number, text: string, onCurve: (name: string) => void): HTMLElement {
    const bounds = this.run.data.bounds ?? [];
    const rows = text.replace(/\n$/, '').split('\n').map((words, i) => {
      const number = i + 1;
      const columns = [...new Set([
        ...bounds.filter((b) => b.file === index && b.line === number && this.run.curve(b.column)).map((b) => b.column),
        ...[...this.run.columns.values()].filter((c) => c.file === index && c.line === number).map((c) => c.name),
      ])];
      const mark = h('span', { class: 'mark' });
      const code = h('span', { class: 'code' }, words || ' ');
      const first = columns.find((name) => !/\.(alpha|residual|saturated)$/.test(name)) ?? columns[0];
      const body = first
        ? h('button', { class: 'line', title: `Show ${first}`, onclick: () => onCurve(first) }, code)
        : h('span', { class: 'line' }, code);
      const element = h('div', { class: 'row', id: `line-${index}-${number}` }, h('span', { class: 'number' }, String(number)), body, mark);
      if (columns.length) this.lines.set(`${index}:${number}`, { element, mark, columns });
      return element;
    });
    return h('div', { class: 'pane', role: 'tabpanel', id: `file-${index}`, 'aria-labelledby': `tab-${index}`, tabindex: 0 }, ...rows);
  }

  private open(index: number): void {
    this.panes.forEach((pane, i) => { pane.hidden = i !== index; });
    this.tabs.forEach((tab, i) => {
      tab.setAttribute('aria-selected', String(i === index));
      tab.tabIndex = i === index ? 0 : -1;
    });
  }

  private onKey(event: KeyboardEvent): void {
    const step = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (!step) return;
    event.stopPropagation();
    const now = this.tabs.findIndex((tab) => tab.getAttribute('aria-selected') === 'true');
    const next = (now + step + this.tabs.length) % this.tabs.length;
    this.open(next);
    this.tabs[next]!.focus();
  }

  show(file: number, line: number): void {
    if (!this.panes[file]) return;
    this.open(file);
    const row = document.getElementById(`line-${file}-${line}`);
    for (const other of document.querySelectorAll('.row.shown')) other.classList.remove('shown');
    row?.classList.add('shown');
    row?.scrollIntoView({ block: 'nearest' });
  }

  private isAtLimit(name: string, i: number, time: number): boolean {
    const value = this.run.curve(name)?.[i];
    if (value === undefined || Number.isNaN(value)) return false;
    if (name.endsWith('.saturated')) return value > 0.5;
    const task = taskAt(this.run, time);
    return (this.run.data.bounds ?? []).some((b) => {
      return b.column === name && (b.task === null || b.task === task) && isNear(value, b.low, b.high);
    });
  }

  private light(time: number): void {
    const i = indexAt(this.run.times, time);
    for (const line of this.watched) {
      const hit = line.columns.find((name) => this.isAtLimit(name, i, time));
      line.element.classList.toggle('lit', hit !== undefined);
      write(line.mark, hit ? '◂ at its limit' : '');
    }
  }
}
