// The grip of the mouse on an object of a live run: it drags an outline to where the object is sent.
import type { Run, SceneObject, World } from './data';
import type { Place } from './motion';
import { isInside } from './push';
import { outlineOf, placeOf, worldPoint } from './world';

export class Grip {
  private held: { object: SceneObject; from: number[]; place: Place } | null = null;

  /** `isNow`: whether the page shows the present. */
  constructor(private readonly run: Run, private readonly world: World, private readonly isNow: () => boolean,
    private readonly send: (name: string, place: Place) => void) {}

  /** False: no object is there. */
  take(point: number[]): boolean {
    if (!this.isNow()) return false;
    for (const object of this.world.scene?.objects ?? []) {
      const place = placeOf(this.run, object, this.run.duration);
      const isThere = object.shape === 'cylinder' ? Math.hypot(point[0]! - place.x, point[1]! - place.y) < object.size[0]!
        : isInside(outlineOf(object).map((corner) => worldPoint(place, corner)), point);
      if (!isThere) continue;
      this.held = { object, from: point, place };
      this.place = place;
      return true;
    }
    return false;
  }
  /** False: it holds nothing. */
  move(point: number[]): boolean {
    if (!this.held) return false;
    const { from, place } = this.held;
    this.place = { ...place, x: place.x + point[0]! - from[0]!, y: place.y + point[1]! - from[1]! };
    return true;
  }
  release(): void {
    const held = this.held;
    this.held = null;
    if (held && Math.hypot(this.place.x - held.place.x, this.place.y - held.place.y) > 0) this.send(held.object.name, this.place);
  }

  /** Where the outline is. */
  private place: Place = { x: 0, y: 0, yaw: 0 };
  get ghost(): { object: SceneObject; place: Place } | null {
    return this.held && { object: this.held.object, place: this.place };
  }
}
