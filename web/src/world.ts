// Frames, objects and contacts of the scene at a time.
import type { Frame, Path, Pose, Region, Robot, Run, SceneObject, World } from './data';
import { indexAt } from './data';
import { baseAt, bodiesIn, heightOf, jointsAt, placeAt, planar, times, at, type Place } from './motion';

export interface Instant {
  time: number;
  base: Place;
  believed: Place | null;  // where zwang has the base, if the plant knows it, too
  baseInWorld: Pose;
  bodies: Pose[];          // in the world
}

export function instantAt(run: Run, robot: Robot, time: number): Instant {
  const base = baseAt(run, time);
  const baseInWorld = planar(base, heightOf(robot));
  const bodies = bodiesIn(robot, jointsAt(run, robot, time)).map((pose) => times(baseInWorld, pose));
  const believed = run.sample('truth.base.x') ? placeAt(run, 'base', time) : null;
  return { time, base, believed, baseInWorld, bodies };
}

/** None of a frame that a signal carries or that a task sets: the log does not say where it is. */
export function frameInWorld(world: World, index: number, now: Instant): Pose | null {
  const frame: Frame | undefined = world.frames[index];
  if (!frame) return null;
  if (frame.set || frame.parent === 'signal') return null;
  if (frame.parent === 'world') return frame.pose;
  const parent = frame.parent === 'body' ? now.bodies[frame.index] : frameInWorld(world, frame.index, now);
  return parent ? times(parent, frame.pose) : null;
}

/** The corners of a region in the world; a circle as many of them. */
export function cornersOf(world: World, region: Region, now: Instant): number[][] | null {
  const parent = frameInWorld(world, region.parent, now);
  if (!parent) return null;
  const corners = region.polygon.length ? region.polygon : Array.from({ length: 48 }, (_, i) => {
    const angle = (i / 48) * 2 * Math.PI;
    return [region.centre[0]! + region.radius * Math.cos(angle), region.centre[1]! + region.radius * Math.sin(angle)];
  });
  return corners.map(([x, y]) => at(parent, [x!, y!, 0]));
}

export function placeOf(run: Run, object: SceneObject, time: number): Place {
  return placeAt(run, `truth.${object.name}`, time) ?? { x: object.at[0]!, y: object.at[1]!, yaw: object.yaw };
}

/** The outline of a box or a wall in its own axes: a wall's `at` is in the middle of its face, which looks along -x. */
export function outlineOf(object: SceneObject): number[][] {
  const [length, width] = object.size as [number, number];
  if (object.shape === 'wall')
    return [[0, -length / 2], [width, -length / 2], [width, length / 2], [0, length / 2]];
  return [[-length / 2, -width / 2], [length / 2, -width / 2], [length / 2, width / 2], [-length / 2, width / 2]];
}

/** The eight corners of a box or a wall that leans, in the world. */
function cornersOfLeaning(object: SceneObject, lean: Pose): number[][] {
  return outlineOf(object).flatMap(([x, y]) => [0, object.size[2]!].map((z) => at(lean, [x!, y!, z])));
}

/** Counter-clockwise, by Andrew's monotone chain. */
function hullOf(points: number[][]): number[][] {
  const sorted = [...points].sort((a, b) => a[0]! - b[0]! || a[1]! - b[1]!);
  const half = (ordered: number[][]): number[][] => {
    const chain: number[][] = [];
    for (const p of ordered) {
      for (;;) {
        const [a, b] = chain.slice(-2) as [number[], number[]];
        if (chain.length < 2 || (b[0]! - a[0]!) * (p[1]! - a[1]!) > (b[1]! - a[1]!) * (p[0]! - a[0]!)) break;
        chain.pop();
      }
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** What the plane z = height cuts out of a box or a wall that leans; empty above and below it. */
function sectionOf(object: SceneObject, lean: Pose, height: number): number[][] {
  const c = cornersOfLeaning(object, lean);  // 2 i at the foot of the corner i of the outline, 2 i + 1 at its head
  const edges = [0, 1, 2, 3].flatMap((i) => [[2 * i, 2 * i + 1], [2 * i, (2 * i + 2) % 8], [2 * i + 1, (2 * i + 3) % 8]]);
  const cut = edges.flatMap(([from, to]) => {
    const [a, b] = [c[from!]!, c[to!]!];
    const share = (height - a[2]!) / (b[2]! - a[2]!);
    return share >= 0 && share <= 1 ? [[a[0]! + share * (b[0]! - a[0]!), a[1]! + share * (b[1]! - a[1]!)]] : [];
  });
  return cut.length > 2 ? hullOf(cut) : [];
}

/** Of a box or a wall, in the world: what a base meets at `height`, and what is seen from above. */
export function outlinesOf(object: SceneObject, place: Place, height: number): { met: number[][]; seen: number[][] } {
  if (!object.lean) {
    const outline = outlineOf(object).map((p) => worldPoint(place, p));
    return { met: outline, seen: outline };
  }
  return { met: sectionOf(object, object.lean, height), seen: hullOf(cornersOfLeaning(object, object.lean)) };
}

/** The points of a path in the world. */
export function pathInWorld(world: World, path: Path, now: Instant): number[][] | null {
  const frame = frameInWorld(world, path.frame, now);
  return frame && path.points.map(([x, y]) => at(frame, [x!, y!, 0]));
}

export function worldPoint(place: Place, point: number[]): [number, number] {
  const [c, s] = [Math.cos(place.yaw), Math.sin(place.yaw)];
  return [place.x + c * point[0]! - s * point[1]!, place.y + s * point[0]! + c * point[1]!];
}

/** [m] Of a force arrow in space: 1 N is seen, 1 kN stays in the picture. Foxglove shows the same (runtime/src/log/foxglove.cpp). */
export const forceLength = (force: number): number => 0.25 * Math.log10(1 + 2 * force);

export interface Contact { at: [number, number]; normal: [number, number]; force: number; name: string }

function nearestOnSegment(p: number[], a: number[], b: number[]): [number, number] {
  const [dx, dy] = [b[0]! - a[0]!, b[1]! - a[1]!];
  const along = ((p[0]! - a[0]!) * dx + (p[1]! - a[1]!) * dy) / Math.max(dx * dx + dy * dy, 1e-12);
  const t = Math.min(1, Math.max(0, along));
  return [a[0]! + t * dx, a[1]! + t * dy];
}

const near = 4;  // [m]

/** The box around the path of the base and around what stands near it: its least and its largest corner. */
export function extentOf(run: Run, world: World): [[number, number], [number, number]] {
  const reach = Math.max(0.3, ...world.robot.footprint.map((corner) => Math.hypot(corner[0]!, corner[1]!)));
  const low: [number, number] = [Infinity, Infinity];
  const high: [number, number] = [-Infinity, -Infinity];
  const take = (x: number, y: number, around: number): void => {
    [low[0], low[1]] = [Math.min(low[0], x - around), Math.min(low[1], y - around)];
    [high[0], high[1]] = [Math.max(high[0], x + around), Math.max(high[1], y + around)];
  };
  for (const time of run.sampleTimes) {
    const base = baseAt(run, time);
    take(base.x, base.y, reach);
  }
  const path = [...low, ...high] as [number, number, number, number];
  for (const object of world.scene?.objects ?? []) {
    const [x, y] = object.at as [number, number];
    const isNear = x > path[0] - near && x < path[2] + near && y > path[1] - near && y < path[3] + near;
    if (isNear) take(x, y, Math.min(0.3, object.size[0]! / 2));
  }
  for (const other of world.scene?.robots ?? []) take(other.at[0]!, other.at[1]!, reach);
  return [low, high];
}

/** How strong a hand gets with the way that it is dragged. [N/m] */
export const pushPerMetre = 150;

const flush = 1e-3;  // [m] an edge that lies on another one touches with both of its ends

/** Where two outlines are nearest, the middle of an edge that lies flush, and the way from the second into the first. */
function nearest(robot: number[][], object: number[][]): { at: [number, number]; normal: [number, number] } {
  const places: { at: [number, number]; normal: [number, number]; distance: number }[] = [];
  const look = (points: number[][], edges: number[][], edgesAreObject: boolean): void => {
    for (const p of points) {
      edges.forEach((a, i) => {
        const b = edges[(i + 1) % edges.length]!;
        const at = nearestOnSegment(p, a, b);
        const length = Math.hypot(b[0]! - a[0]!, b[1]! - a[1]!);
        // Counter-clockwise: the outside of an edge is on its right.
        const out: [number, number] = [(b[1]! - a[1]!) / length, -(b[0]! - a[0]!) / length];
        places.push({ at, normal: edgesAreObject ? out : [-out[0], -out[1]], distance: Math.hypot(p[0]! - at[0], p[1]! - at[1]) });
      });
    }
  };
  look(robot, object, true);
  look(object, robot, false);
  const best = places.reduce((least, one) => (one.distance < least.distance ? one : least));
  const touching = places.filter((one) => one.distance <= best.distance + flush).map((one) => one.at);
  const middle = (axis: 0 | 1): number => {
    const values = touching.map((at) => at[axis]);
    return (Math.min(...values) + Math.max(...values)) / 2;
  };
  return { at: [middle(0), middle(1)], normal: best.normal };
}

/** Of a live run: what a hand presses with, drawn as far as it was dragged. */
export function pushAt(run: Run, now: Instant): { from: number[]; to: number[]; force: [number, number] } | null {
  const i = indexAt(run.sampleTimes, now.time);
  const [x, y, fx, fy] = ['hand.at.x', 'hand.at.y', 'hand.force.x', 'hand.force.y'].map((name) => run.sample(name)?.[i] ?? 0) as [number, number, number, number];
  if (fx === 0 && fy === 0) return null;
  const from = worldPoint(now.base, [x, y]);
  return { from, to: [from[0]! + fx / pushPerMetre, from[1]! + fy / pushPerMetre], force: [fx, fy] };
}

/** The forces that the plant measured, at the place where the outlines are nearest. */
export function contactsAt(run: Run, world: World, now: Instant): Contact[] {
  const contacts: Contact[] = [];
  const robot = world.robot.footprint.map((corner) => worldPoint(now.base, corner));
  if (!world.scene || robot.length < 3) return contacts;
  for (const object of world.scene.objects) {
    const force = run.curve(`truth.${object.name}.force`)?.[indexAt(run.times, now.time)] ?? 0;
    if (!(force > 0)) continue;
    const place = placeOf(run, object, now.time);
    const outline = object.shape === 'cylinder'
      ? Array.from({ length: 24 }, (_, i) => worldPoint(place, [object.size[0]! * Math.cos((i * Math.PI) / 12), object.size[0]! * Math.sin((i * Math.PI) / 12)]))
      : outlinesOf(object, place, world.robot.height).met;
    if (outline.length > 2) contacts.push({ ...nearest(robot, outline), force, name: object.name });
  }
  return contacts;
}
