// The tasks and the ways between them, with the path that the run took.
import type { Moments } from './clock';
import { stretchAt, type Run } from './data';
import { h, svg } from './dom';
import { seconds } from './units';

const shown = (node: string): string =>
  node === 'always' ? 'in any task' : node === 'back' ? 'back' : node.replace(/^task /, '');

/** How many ways a task is from the start. */
function depths(start: string, nodes: string[], edges: { from: string; to: string }[]): Map<string, number> {
  const depth = new Map([[start, 0]]);
  const queue = [start];
  while (queue.length) {
    const node = queue.shift()!;
    for (const edge of edges) {
      if (edge.from !== node || depth.has(edge.to)) continue;
      depth.set(edge.to, depth.get(node)! + 1);
      queue.push(edge.to);
    }
  }
  for (const node of nodes) if (!depth.has(node)) depth.set(node, 0);
  const last = Math.max(...depth.values());
  if (depth.has('done')) depth.set('done', Math.max(last, depth.get('done')!));
  if (depth.has('failed')) depth.set('failed', Math.max(last, depth.get('failed')!));
  return depth;
}

export function graph(run: Run, clock: Moments): HTMLElement {
  const { graph: whole, tasks, begin, report } = run.data;
  if (!whole) return h('p', { class: 'note' }, 'The files of this run do not load any more: no graph.');
  const nodes = [...new Set([...whole.tasks, ...whole.edges.flatMap((edge) => [edge.from, edge.to])])];
  const depth = depths(whole.start, nodes, whole.edges);
  const columns = new Map<number, string[]>();
  for (const node of nodes) columns.set(depth.get(node)!, [...(columns.get(depth.get(node)!) ?? []), node]);
  const [width, height, gapX, gapY, lift] = [132, 34, 64, 22, 26];
  const most = Math.max(...[...columns.values()].map((column) => column.length));
  const skippedBy = (edge: { from: string; to: string }): number => Math.max(0, depth.get(edge.to)! - depth.get(edge.from)! - 1);
  // A curve reaches three quarters of the way to its control points.
  const above = 12 + 0.75 * lift * Math.max(0, ...whole.edges.map(skippedBy));
  const place = new Map<string, [number, number]>();
  for (const [x, column] of columns) {
    column.forEach((node, y) => place.set(node, [10 + x * (width + gapX), above + (y + (most - column.length) / 2) * (height + gapY)]));
  }
  // A run that is over ends in `done` or `failed`, tasks of the log, too.
  const path = tasks.map((one) => (['done', 'failed'].includes(one.task) ? one.task : `task ${one.task}`));
  const taken = new Map<string, number>();
  const count = (key: string): void => { taken.set(key, (taken.get(key) ?? 0) + 1); };
  const isEdge = (from: string, to: string): boolean => whole.edges.some((edge) => edge.from === from && edge.to === to);
  path.slice(1).forEach((to, i) => {
    const from = path[i]!;
    if (isEdge(from, to)) count(`${from} ${to}`);
    else if (isEdge('always', to)) count(`always ${to}`);
    else count(`${from} back`);
  });
  const edges = whole.edges.map((edge, i) => {
    const [x1, y1] = place.get(edge.from)!;
    const [x2, y2] = place.get(edge.to)!;
    const isAhead = x2 > x1;
    const from = [x1 + (isAhead ? width : width / 2), y1 + (isAhead ? height / 2 : 0)];
    const to = [x2 + (isAhead ? 0 : width / 2), y2 + (isAhead ? height / 2 : 0)];
    // A way that skips a column of tasks goes around it.
    const skipped = skippedBy(edge);
    const bend = isAhead ? gapX / 2 + 40 * skipped : 0;
    const up = isAhead ? lift * skipped : 20;
    const visits = taken.get(`${edge.from} ${edge.to}`) ?? 0;
    return svg('path', {
      d: `M ${from[0]} ${from[1]} C ${from[0]! + bend} ${from[1]! - up}, ${to[0]! - bend} ${to[1]! - up}, ${to[0]} ${to[1]}`,
      class: `edge${edge.dashed ? ' dashed' : ''}${visits ? ' taken' : ''}`, 'marker-end': 'url(#tip)',
    }, svg('title', {}, `${i + 1}: ${edge.label}${visits ? `, taken ${visits} times` : ''}`));
  });
  const boxes = nodes.map((node) => {
    const [x, y] = place.get(node)!;
    const visits = path.filter((one) => one === node).length;
    const text = svg('text', { x: x + width / 2, y: y + height / 2 + 4, 'text-anchor': 'middle' }, shown(node) + (visits > 1 ? ` ×${visits}` : ''));
    return svg('g', { class: `node${visits ? ' visited' : ''}`, 'data-node': node },
      svg('rect', { x, y, width, height, rx: ['done', 'failed'].includes(node) ? 17 : 6 }), text);
  });
  const right = Math.max(...[...place.values()].map(([x]) => x)) + width + 10;
  const bottom = Math.max(...[...place.values()].map(([, y]) => y)) + height + 10;
  const picture = svg('svg', { viewBox: `0 0 ${right} ${bottom}`, width: right, height: bottom, role: 'img', 'aria-label': `Graph of the tasks; the run took ${path.map(shown).join(', ')}` },
    svg('defs', {}, svg('marker', { id: 'tip', viewBox: '0 0 8 8', refX: 8, refY: 4, markerWidth: 8, markerHeight: 8, orient: 'auto', markerUnits: 'userSpaceOnUse' }, svg('path', { d: 'M 0 0 L 8 4 L 0 8 z' }))),
    ...edges, ...boxes);
  clock.onTime((time) => {
    const now = path[stretchAt(run, time)];
    for (const box of picture.querySelectorAll('.node')) box.classList.toggle('active', box.getAttribute('data-node') === now);
  });
  const steps = (report?.transitions ?? []).map((one) => h('li', {},
    h('button', { class: 'link', onclick: () => clock.show(one.time - begin) }, seconds(one.time - begin)),
    ` ${one.from ?? 'start'} → ${one.to}: ${one.why}`));
  return h('div', {}, h('div', { class: 'scroll', tabindex: 0 }, picture), h('ol', { class: 'steps' }, ...steps));
}
