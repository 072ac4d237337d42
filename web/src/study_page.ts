// The page of `zwang sweep --report`: how sure each expectation is, and what its margin goes with.
import { colour, ofStyle, onScheme } from './colours';
import type { StudyClaim, StudyData } from './data';
import { h, part } from './dom';
import { margins, overDraw, paint, type Chart } from './study_charts';
import { cell as td, table } from './tables';

const signs: Record<string, string> = { held: '✓ held', broken: '✗ broken', 'too few runs': '? too few runs' };

/** With as many digits as tell it from 100 %. */
function percent(share: number): string {
  const rest = Math.min(share, 1 - share);
  const needed = rest > 0 ? Math.ceil(-Math.log10(100 * rest)) + 1 : 2;
  return `${(100 * share).toFixed(Math.min(8, Math.max(2, needed)))} %`;
}

const wanted = (claim: StudyClaim): string =>
  claim.probability === undefined ? 'each cell' : `at least ${+(100 * claim.probability).toFixed(4)} % of all cells, sure to ${+(100 * claim.confidence).toFixed(4)} %`;

/** Chance alone makes a rank correlation as large as this twice in a hundred thousand studies. */
const byChance = (claim: StudyClaim): number => 4 / Math.sqrt(Math.max(1, claim.runs - 1));

function goesWith(claim: StudyClaim): string {
  const strong = claim.correlations
    .filter((one) => Math.abs(one.margin ?? 0) > byChance(claim))
    .sort((a, b) => Math.abs(b.margin!) - Math.abs(a.margin!));
  return strong.length ? `The margin goes with ${strong.map((one) => `${one.draw} (${one.margin!.toFixed(2)})`).join(', ')}.` : 'The margin goes with no draw.';
}

/** The charts of an expectation: its margins, and these over each draw, the strongest first. */
function charts(data: StudyData, index: number): Chart[] {
  const claim = data.study.expectations[index]!;
  const strength = (name: string): number => Math.abs(claim.correlations.find((one) => one.draw === name)?.margin ?? 0);
  const order = data.draws.map((_, i) => i).sort((a, b) => strength(data.draws[b]!.name) - strength(data.draws[a]!.name));
  return [margins(data, index), ...order.map((draw) => overDraw(data, index, draw))];
}

function claimItem(data: StudyData, index: number): HTMLElement {
  const claim = data.study.expectations[index]!;
  const hasMargins = claim.margins !== undefined;
  const body = h('div', { class: 'detail' });
  const head = h('button', { class: 'head', 'aria-expanded': 'false', onclick: () => toggle() },
    h('span', {}, h('strong', {}, signs[claim.verdict] ?? claim.verdict), claim.text),
    h('span', {}, `${claim.held} of ${claim.runs} cells, between ${percent(claim.share[0])} and ${percent(claim.share[1])} of all`),
    h('span', {}, `wanted: ${wanted(claim)}`));
  const item = h('li', { class: claim.verdict === 'broken' ? 'bad' : claim.verdict === 'held' ? 'good' : 'open', id: `claim-${index}` }, head);
  function open(): void {
    if (!hasMargins) {
      body.append(h('p', {}, 'It has no margin: it holds or it does not.'));
      return;
    }
    const quantiles = claim.margins!.map((one) => `${(100 * one.margin).toFixed(1)} % ${one.share === 0 ? 'at least' : one.share === 0.5 ? 'in the middle' : `of the worst ${100 * one.share} %`}`);
    const frames = charts(data, index).map((chart) => {
      const canvas = h('canvas', { class: 'study-chart', role: 'img', 'aria-label': chart.label });
      return { chart, canvas, figure: h('figure', {}, canvas, h('figcaption', {}, chart.caption)) };
    });
    body.append(h('p', {}, `Margin: ${quantiles.join(', ')}. ${goesWith(claim)}`), h('div', { class: 'study-charts' }, ...frames.map((one) => one.figure)));
    const draw = (): void => frames.forEach(({ chart, canvas }) => paint(canvas, chart, { ink: ofStyle('--ink'), line: ofStyle('--line'), held: colour(0), missed: ofStyle('--bad') }));
    requestAnimationFrame(draw);
    onScheme(draw);
    new ResizeObserver(draw).observe(body);
  }
  function toggle(): void {
    const isOpen = head.getAttribute('aria-expanded') !== 'true';
    head.setAttribute('aria-expanded', String(isOpen));
    if (isOpen) item.append(body);
    else body.remove();
    if (isOpen && !body.hasChildNodes()) open();
  }
  if (hasMargins && (claim.verdict === 'broken' || index === data.study.expectations.findIndex((one) => one.margins))) toggle();
  return item;
}

function worst(data: StudyData): HTMLElement {
  return table(['cell', 'ended', 'margin', 'expected', 'drawn, and why', 'again'], data.study.worst.map((one) => {
    const drawn = [data.study.groups.length ? one.of_matrix : '', ...data.draws.map((draw) => `${draw.name} ${Number((one.drawn[draw.name] ?? 0).toPrecision(4))}${draw.unit ? ` ${draw.unit}` : ''}`)].filter(Boolean).join(', ');
    return h('tr', {}, td(String(one.cell), 'figure'), td(one.outcome), td(one.margin === undefined ? 'missed' : `${(100 * one.margin).toFixed(1)} %`, 'figure'), td(one.expectation),
      h('td', {}, drawn, (one.why || one.because) && h('p', { class: 'note' }, one.why || one.because)), h('td', {}, h('code', {}, `${data.command}${one.cell} --report`)));
  }));
}

export function studyPage(data: StudyData): void {
  const { study } = data;
  const held = study.expectations.filter((one) => one.verdict === 'held').length;
  const open = study.expectations.filter((one) => one.verdict === 'too few runs').length;
  const [sign, kind] = !study.passed ? ['✗', 'failed'] : open > 0 || study.cells < study.wanted ? ['?', 'cut'] : ['✓', 'done'];
  const ended = Object.entries(study.outcomes).map(([outcome, count]) => `${count} ${outcome}`).join(', ');
  const sentence = `${held} of ${study.expectations.length} expectations held${open > 0 ? `, ${open} with too few runs` : ''}; ${study.cells} of ${study.wanted} cells: ${ended}.`;
  document.title = `zwang sweep: ${sentence}`;
  const shown = data.points.cells.length;
  document.getElementById('page')!.append(
    h('header', { class: `verdict ${kind}` }, h('h1', {}, h('span', { 'aria-hidden': 'true' }, `${sign} `), 'zwang sweep'),
      h('p', { id: 'verdict' }, sentence), h('p', {}, `${study.study}${data.about ? `: ${data.about}` : ''}`)),
    h('main', { class: 'single' },
      part('claims', 'Expectations', h('ol', { class: 'cells' }, ...study.expectations.map((_, i) => claimItem(data, i))),
        shown < study.cells && h('p', { class: 'note' }, `Charts show ${shown} of ${study.cells} cells: those that missed anything, and others evenly.`)),
      study.groups.length > 0 && part('groups', 'By the drawn files', table(['drawn', 'cells in which all held'], study.groups.map((one) => h('tr', { class: one.hold < one.runs ? 'broken' : '' }, td(one.name), td(`${one.hold} of ${one.runs}`, 'figure'))))),
      study.worst.length > 0 && part('worst', 'Worst cells', worst(data))));
  (window as unknown as { zwang: unknown }).zwang = { data };
}
