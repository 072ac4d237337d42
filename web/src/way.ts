// The way of the base in a cell, from above, as one small picture.
import type { Cell, MatrixData, SceneObject } from './data';
import { svg } from './dom';
import { outlineOf, worldPoint } from './world';

type Point = [number, number];

function cornersOf(object: SceneObject): Point[] {
  const place = { x: object.at[0]!, y: object.at[1]!, yaw: object.yaw };
  const outline = object.shape === 'cylinder'
    ? Array.from({ length: 24 }, (_, i) => [object.size[0]! * Math.cos((i * Math.PI) / 12), object.size[0]! * Math.sin((i * Math.PI) / 12)])
    : outlineOf(object);
  return outline.map((corner) => worldPoint(place, corner));
}

export function way(data: MatrixData, cell: Cell): SVGElement | null {
  const scene = cell.scene === undefined ? undefined : data.scenes[cell.scene];
  const { path } = cell.story;
  if (!scene || path.length < 3) return null;
  const places = Array.from({ length: path.length / 3 }, (_, i) => ({ x: path[3 * i]!, y: path[3 * i + 1]!, yaw: path[3 * i + 2]! }));
  const reach = Math.max(0.3, ...scene.footprint.map((corner) => Math.hypot(corner[0]!, corner[1]!)));
  const [xs, ys] = [places.map((p) => p.x), places.map((p) => p.y)];
  const [left, right] = [Math.min(...xs) - reach - 0.3, Math.max(...xs) + reach + 0.3];
  const [low, high] = [Math.min(...ys) - reach - 0.3, Math.max(...ys) + reach + 0.3];
  // The picture's y looks down.
  const text = (points: Point[]): string => points.map(([x, y]) => `${x.toFixed(3)},${(-y).toFixed(3)}`).join(' ');
  const size = Math.max(right - left, high - low);
  const line = 0.006 * size;
  const robot = (i: number, kind: string): SVGElement =>
    svg('polygon', { class: kind, points: text(scene.footprint.map((corner) => worldPoint(places[i]!, corner))), 'stroke-width': line, 'stroke-dasharray': kind === 'start' ? `${3 * line} ${2 * line}` : null });
  const last = places.at(-1)!;
  return svg('svg', { class: 'path-view', viewBox: `${left} ${-high} ${right - left} ${high - low}`, role: 'img',
    'aria-label': `The way of the base from above: from x ${xs[0]!.toFixed(2)} m, y ${ys[0]!.toFixed(2)} m to x ${last.x.toFixed(2)} m, y ${last.y.toFixed(2)} m` },
    ...scene.objects.map((object) => svg('polygon', { class: 'object', points: text(cornersOf(object)), 'stroke-width': line / 2 }, svg('title', {}, `${object.name}, as the run began`))),
    robot(0, 'start'),
    svg('polyline', { class: 'way', points: text(places.map((p): Point => [p.x, p.y])), 'stroke-width': 2 * line }),
    robot(places.length - 1, 'base'));
}
