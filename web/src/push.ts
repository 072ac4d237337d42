// The hand of the mouse: it holds a point of the base, and pulls it towards the pointer.
import type { Place } from './motion';
import { pushPerMetre as perMetre, worldPoint } from './world';

export interface Push { at: [number, number]; force: [number, number] }

const strongest = 300;  // [N]; the program takes up to 500 N
const every = 40;       // [ms]

/** Whether a point lies in a polygon, whose corners follow one another. */
export function isInside(polygon: number[][], [x, y]: number[]): boolean {
  let inside = false;
  polygon.forEach((a, i) => {
    const b = polygon[(i + 1) % polygon.length]!;
    const crosses = (a[1]! > y!) !== (b[1]! > y!);
    if (crosses && x! < a[0]! + ((y! - a[1]!) / (b[1]! - a[1]!)) * (b[0]! - a[0]!)) inside = !inside;
  });
  return inside;
}

export class Hand {
  /** Where it holds the base, in the base's axes [m], and where the pointer is in the world [m]. */
  private held: { at: [number, number]; to: number[] } | null = null;
  private timer = 0;

  /** `base`: where it stands now; null while the page shows an earlier moment. */
  constructor(private readonly tell: (push: Push) => void, private readonly base: () => Place | null) {}

  /** Takes hold of the point of the world. */
  take(point: number[]): void {
    const base = this.base();
    if (!base) return;
    const { x, y, yaw } = base;
    const [dx, dy] = [point[0]! - x, point[1]! - y];
    this.held = { at: [Math.cos(yaw) * dx + Math.sin(yaw) * dy, -Math.sin(yaw) * dx + Math.cos(yaw) * dy], to: point };
    clearInterval(this.timer);
    this.timer = window.setInterval(() => this.told(), every);
  }
  /** False: it holds nothing. */
  move(point: number[]): boolean {
    if (!this.held) return false;
    this.held.to = point;
    return true;
  }
  release(): void {
    if (!this.held) return;
    clearInterval(this.timer);
    this.held = null;
    this.tell({ at: [0, 0], force: [0, 0] });
  }
  /** A push of its own at the base's origin, as keys make it. */
  press(force: [number, number]): void {
    this.tell({ at: [0, 0], force });
  }

  /** From where to where in the world, and how strong; null while it holds nothing. */
  get arrow(): { from: number[]; to: number[]; force: [number, number] } | null {
    const base = this.base();
    if (!this.held || !base) return null;
    const from = worldPoint(base, this.held.at);
    const way = [this.held.to[0]! - from[0]!, this.held.to[1]! - from[1]!];
    const share = Math.min(1, strongest / Math.max(1e-9, perMetre * Math.hypot(way[0]!, way[1]!)));
    return { from, to: this.held.to, force: [perMetre * share * way[0]!, perMetre * share * way[1]!] };
  }

  private told(): void {
    const force = this.arrow?.force ?? [0, 0];
    if (this.held) this.tell({ at: this.held.at, force });
  }
}
