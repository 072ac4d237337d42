// Lines of the task in the top view: regions and paths.
import { ofStyle } from './colours';
import type { World } from './data';
import type { Label } from './labels';
import { cornersOf, pathInWorld, type Instant } from './world';

export type Point = number[];
export type ToPixels = (p: Point) => [number, number];

const ofRegion = [10, 5];  // [px] dashes
const ofPath = [2, 6];

export function polyline(c: CanvasRenderingContext2D, to: ToPixels, points: Point[]): void {
  c.beginPath();
  points.forEach((p, i) => (i ? c.lineTo(...to(p)) : c.moveTo(...to(p))));
}

export function polygon(c: CanvasRenderingContext2D, to: ToPixels, points: Point[]): void {
  polyline(c, to, points);
  c.closePath();
}

function strokeDashed(c: CanvasRenderingContext2D, dashes: number[]): void {
  c.strokeStyle = ofStyle('--region');
  c.setLineDash(dashes);
  c.lineWidth = 2;
  c.stroke();
  c.setLineDash([]);
}

/** Their names. */
export function drawRegions(c: CanvasRenderingContext2D, to: ToPixels, world: World, now: Instant): Label[] {
  const labels: Label[] = [];
  for (const region of world.regions) {
    const corners = cornersOf(world, region, now);
    if (!corners) continue;
    polygon(c, to, corners);
    strokeDashed(c, ofRegion);
    labels.push({ text: region.name, at: to(corners[0]!), style: ofStyle('--region') });
  }
  return labels;
}

/** Their names, at the first points. A path whose frame a task sets or a signal carries is not drawn. */
export function drawPaths(c: CanvasRenderingContext2D, to: ToPixels, world: World, now: Instant): Label[] {
  const labels: Label[] = [];
  for (const path of world.paths ?? []) {
    const points = pathInWorld(world, path, now);
    if (!points) continue;
    polyline(c, to, points);
    strokeDashed(c, ofPath);
    labels.push({ text: path.name, at: to(points[0]!), style: ofStyle('--region') });
  }
  return labels;
}
