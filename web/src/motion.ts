// Where everything stands at a time: interpolated between two records of the log.
import { indexAt, type Pose, type Robot, type Run } from './data';

export interface Place { x: number; y: number; yaw: number }

/** The value at a time, on a straight line between two samples; angles the short way around. */
function valueAt(run: Run, values: Float32Array, time: number, isAngle: boolean): number {
  const i = indexAt(run.sampleTimes, time);
  const j = Math.min(i + 1, values.length - 1);
  const a = values[i]!;
  let step = values[j]! - a;
  if (!Number.isFinite(step)) return a;
  if (isAngle) step = Math.atan2(Math.sin(step), Math.cos(step));
  const span = run.sampleTimes[j]! - run.sampleTimes[i]!;
  return span > 0 ? a + step * Math.min(1, (time - run.sampleTimes[i]!) / span) : a;
}

/** Of `truth.base`, `base`, `truth.crate`: none where the log does not have it. */
export function placeAt(run: Run, of: string, time: number): Place | null {
  const [x, y, yaw] = ['x', 'y', 'yaw'].map((part) => run.sample(`${of}.${part}`));
  if (!x || !y || !yaw) return null;
  const place = { x: valueAt(run, x, time, false), y: valueAt(run, y, time, false), yaw: valueAt(run, yaw, time, true) };
  return Number.isFinite(place.x + place.y + place.yaw) ? place : null;
}

/** Where the plant has the base; where nobody knows better, where zwang has it. */
export const baseAt = (run: Run, time: number): Place =>
  placeAt(run, 'truth.base', time) ?? placeAt(run, 'base', time) ?? { x: 0, y: 0, yaw: 0 };

export function jointsAt(run: Run, robot: Robot, time: number): number[] {
  return robot.bodies.slice(1).map((body, j) => {
    const q = run.sample(`${body.joint}.q`);
    return q ? valueAt(run, q, time, false) : (robot.posture[j] ?? 0);
  });
}

export const identity: Pose = { p: [0, 0, 0], r: [1, 0, 0, 0, 1, 0, 0, 0, 1] };

export function times(a: Pose, b: Pose): Pose {
  const r: number[] = [];
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) r.push([0, 1, 2].reduce((sum, k) => sum + a.r[3 * i + k]! * b.r[3 * k + j]!, 0));
  }
  return { r, p: at(a, b.p) };
}

export function at(pose: Pose, point: number[]): number[] {
  return [0, 1, 2].map(
    (i) => pose.p[i]! + pose.r[3 * i]! * point[0]! + pose.r[3 * i + 1]! * point[1]! + pose.r[3 * i + 2]! * point[2]!,
  );
}

export function planar(place: Place, z = 0): Pose {
  const [c, s] = [Math.cos(place.yaw), Math.sin(place.yaw)];
  return { p: [place.x, place.y, z], r: [c, -s, 0, s, c, 0, 0, 0, 1] };
}

/** Rodrigues: R = 1 + sin q K + (1 - cos q) K^2, K the cross product with the axis. */
function turned(axis: number[], q: number): Pose {
  const [x, y, z] = axis as [number, number, number];
  const [c, s] = [Math.cos(q), Math.sin(q)];
  const v = 1 - c;
  return {
    p: [0, 0, 0],
    r: [c + x * x * v, x * y * v - z * s, x * z * v + y * s, y * x * v + z * s, c + y * y * v, y * z * v - x * s,
      z * x * v - y * s, z * y * v + x * s, c + z * z * v],
  };
}

/** The pose of each body in the base. */
export function bodiesIn(robot: Robot, q: number[]): Pose[] {
  const poses: Pose[] = [];
  robot.bodies.forEach((body, i) => {
    if (body.parent < 0) return poses.push(identity);
    const value = q[i - 1] ?? 0;
    const moved = body.type === 'prismatic' ? { ...identity, p: body.axis.map((a) => a * value) }
      : body.type === 'revolute' ? turned(body.axis, value) : identity;
    return poses.push(times(times(poses[body.parent]!, body.pose), moved));
  });
  return poses;
}

/** How high the base's origin is above the floor on which its wheels stand. */
export function heightOf(robot: Robot): number {
  const bodies = bodiesIn(robot, robot.posture);
  const heights = robot.wheels.map((wheel) => wheel.radius - bodies[wheel.body]!.p[2]!);
  return heights.length ? Math.max(...heights) : 0;
}
