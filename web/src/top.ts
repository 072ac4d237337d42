// The top view: robot, scene, regions, frames and forces, drawn in the plane; of two runs both.
import type { Clock } from './clock';
import { ofStyle, onScheme } from './colours';
import type { Run, SceneObject, World } from './data';
import { h, sizeOf } from './dom';
import type { Grip } from './grip';
import { drawLabels, type Box, type Label } from './labels';
import { drawPaths, drawRegions, polygon, type Point, type ToPixels } from './lines';
import { isInside, type Hand } from './push';
import { withUnit } from './units';
import { contactsAt, extentOf, frameInWorld, instantAt, outlinesOf, placeOf, pushAt, worldPoint, type Instant } from './world';
import type { Place } from './motion';

const words = '12px system-ui, sans-serif';

/** A run in the view; `letter` tells it from another one. */
export interface Viewed { run: Run; world: World; letter?: string }

/** What tells the first run from the second: the dashes more than the colour. */
const looks = [{ style: '--accent', fill: '--robot', dashes: [] as number[] }, { style: '--link', fill: '--other', dashes: [7, 4] }];

/** The path of the base, as the plant has it; where nobody knows better, as zwang has it. */
function pathOf(run: Run): Point[] {
  const [x, y] = [run.sample('truth.base.x') ?? run.sample('base.x'), run.sample('truth.base.y') ?? run.sample('base.y')];
  const path: Point[] = [];
  for (let i = 0; x && y && i < x.length; ++i) {
    if (Number.isFinite(x[i]! + y[i]!)) path.push([x[i]!, y[i]!]);
  }
  return path;
}

export class TopView {
  readonly element: HTMLElement;
  follow = false;
  /** Of a run that goes on: a drag that begins on the robot pushes it, one that begins on an object moves that. */
  takeHands(hand: Hand, grip: Grip): void {
    this.pusher = hand;
    this.grip = grip;
    this.caption.append(' A drag that begins on the robot pushes it; one on an object sends that there.');
  }
  private pusher: Hand | null = null;
  private grip: Grip | null = null;
  private readonly caption = h('figcaption', {});
  private readonly canvas = h('canvas', { class: 'view', tabindex: 0, role: 'img' });
  private readonly size = sizeOf(this.canvas, () => this.draw());
  private scale = 100;
  private centre: Point = [0, 0];
  private zoom = 1;
  private paths: Point[][];
  private isTouched = false;
  private labels: Label[] = [];
  /** What is written in the view now, and where [px]. */
  shownLabels: Box[] = [];

  constructor(private readonly viewed: Viewed[], private readonly clock: Clock) {
    const dashed = viewed.length > 1 ? `Solid: run ${viewed[0]!.letter}. Dashed: run ${viewed[1]!.letter}.` : 'Dashed: where zwang has the base.';
    this.caption.append(`From above. Wheel or + and - zoom, a drag moves. ${dashed}`);
    this.element = h('figure', {}, this.canvas, this.caption);
    this.paths = viewed.map(({ run }) => pathOf(run));
    this.fit();
    clock.onTime(() => this.draw());
    onScheme(() => this.draw());
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.setZoom(this.zoom * Math.exp(-event.deltaY / 400));
    }, { passive: false });
    this.canvas.addEventListener('keydown', (event) => {
      if (event.key === '+') this.setZoom(this.zoom * 1.25);
      if (event.key === '-') this.setZoom(this.zoom / 1.25);
    });
    this.canvas.addEventListener('pointerdown', (event) => {
      const point = this.toWorld(event);
      if (event.button !== 0 || !this.pusher) return;
      const isOnRobot = isInside(this.footprint(), point);
      if (isOnRobot) this.pusher.take(point);
      if (isOnRobot || this.grip?.take(point)) this.canvas.setPointerCapture(event.pointerId);
    });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      this.canvas.addEventListener(end, () => {
        this.pusher?.release();
        this.grip?.release();
      });
    }
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.buttons !== 1) return;
      const point = this.toWorld(event);
      if (this.pusher?.move(point) || this.grip?.move(point)) return this.draw();
      this.isTouched = true;
      this.centre = [this.centre[0]! - event.movementX / this.pixels(), this.centre[1]! + event.movementY / this.pixels()];
      this.draw();
    });
  }

  /** The runs have grown; drawn with the next time. */
  grow(): void {
    this.paths = this.viewed.map(({ run }) => pathOf(run));
    if (!this.isTouched) this.fit();
  }

  setZoom(zoom: number): void {
    this.isTouched = true;
    this.zoom = Math.min(40, Math.max(0.2, zoom));
    this.draw();
  }

  private fit(): void {
    const extents = this.viewed.map(({ run, world }) => extentOf(run, world));
    const low = [0, 1].map((i) => Math.min(...extents.map((one) => one[0][i]!))) as [number, number];
    const high = [0, 1].map((i) => Math.max(...extents.map((one) => one[1][i]!))) as [number, number];
    this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    this.scale = 1.15 * Math.max(high[0] - low[0], high[1] - low[1]);
  }

  private pixels(): number {
    return (Math.min(...this.size()) / this.scale) * this.zoom;
  }

  private shownCentre(): Point {
    const base = this.first().base;
    return this.follow ? [base.x, base.y] : this.centre;
  }
  private first(): Instant {
    const { run, world } = this.viewed[0]!;
    return instantAt(run, world.robot, Math.min(this.clock.time, run.duration));
  }
  private footprint(): Point[] {
    return this.viewed[0]!.world.robot.footprint.map((corner) => worldPoint(this.first().base, corner));
  }
  /** From a point of the world [m] to one of the canvas [px]. */
  mapping(): ToPixels {
    const [width, height] = this.size();
    const [centre, s] = [this.shownCentre(), this.pixels()];
    return (p) => [width / 2 + (p[0]! - centre[0]!) * s, height / 2 - (p[1]! - centre[1]!) * s];
  }
  private toWorld(event: PointerEvent): Point {
    const [width, height] = this.size();
    const [centre, s] = [this.shownCentre(), this.pixels()];
    return [centre[0]! + (event.offsetX - width / 2) / s, centre[1]! - (event.offsetY - height / 2) / s];
  }

  draw(): void {
    const [width, height] = this.size();
    const ratio = devicePixelRatio || 1;
    if (width === 0) return;
    if (this.canvas.width !== Math.round(width * ratio)) this.canvas.width = Math.round(width * ratio);
    if (this.canvas.height !== Math.round(height * ratio)) this.canvas.height = Math.round(height * ratio);
    const c = this.canvas.getContext('2d')!;
    // A run that is over stays where it ended.
    const nows = this.viewed.map(({ run, world }) => instantAt(run, world.robot, Math.min(this.clock.time, run.duration)));
    const centre = this.shownCentre();
    const s = this.pixels();
    const to = this.mapping();
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    c.font = words;
    this.labels = [];
    this.drawGrid(c, to, s, width, height, centre);
    this.viewed.forEach((one, i) => this.drawScene(c, to, one, nows[i]!, s, i > 0));
    this.viewed.forEach((one, i) => this.drawPath(c, to, one, this.paths[i]!, i));
    this.viewed.forEach((one, i) => this.drawRobot(c, to, one, nows[i]!, i));
    this.viewed.forEach((one, i) => this.drawForces(c, to, one, nows[i]!));
    this.drawHand(c, to, nows[0]!);
    this.shownLabels = drawLabels(c, this.labels.map((one) => ({ font: words, ...one })), width, height, ofStyle('--view'));
    const places = nows.map((now, i) => `${this.viewed[i]!.letter ? `run ${this.viewed[i]!.letter}, ` : ''}base at x ${now.base.x.toFixed(3)} m, ` +
      `y ${now.base.y.toFixed(3)} m, heading ${withUnit(now.base.yaw, 'rad')}`);
    this.canvas.setAttribute('aria-label', `Top view at ${this.clock.time.toFixed(3)} s: ${places.join('; ')}`);
    nows.forEach((now, i) => { this.canvas.dataset[i ? 'otherPose' : 'pose'] = [now.base.x, now.base.y, now.base.yaw].join(' '); });
  }

  private drawGrid(c: CanvasRenderingContext2D, to: ToPixels, s: number, width: number, height: number, centre: Point): void {
    const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 50].find((metres) => metres * s > 45) ?? 100;
    c.strokeStyle = ofStyle('--grid');
    c.lineWidth = 1;
    c.beginPath();
    for (let x = Math.floor((centre[0]! - width / 2 / s) / step) * step; x < centre[0]! + width / 2 / s; x += step) {
      c.moveTo(to([x, 0])[0], 0);
      c.lineTo(to([x, 0])[0], height);
    }
    for (let y = Math.floor((centre[1]! - height / 2 / s) / step) * step; y < centre[1]! + height / 2 / s; y += step) {
      c.moveTo(0, to([0, y])[1]);
      c.lineTo(width, to([0, y])[1]);
    }
    c.stroke();
    this.labels.push({ text: `grid ${step} m`, at: [2, height - 5], style: ofStyle('--quiet') });
  }

  /** `isSecond`: outlines alone, dashed, of what is not where the first run has it. */
  private drawScene(c: CanvasRenderingContext2D, to: ToPixels, { run, world }: Viewed, now: Instant, s: number, isSecond: boolean): void {
    if (!isSecond) {
      this.labels.push(...drawRegions(c, to, world, now), ...drawPaths(c, to, world, now));
    }
    c.setLineDash(isSecond ? looks[1]!.dashes : []);
    for (const object of world.scene?.objects ?? []) {
      const place = placeOf(run, object, now.time);
      if (isSecond && this.hasAlready(object.name, place)) continue;
      this.outline(c, to, object, place, s, world.robot.height);
      this.finishObject(c, to, place, object.name, isSecond);
      if (object.lean && !isSecond) this.drawSeen(c, to, object, place);
    }
    for (const robot of world.scene?.robots ?? []) {
      const place = placeOf(run, { ...robot, shape: 'box', size: [], moves: true }, now.time);
      if (!robot.robot || (isSecond && this.hasAlready(robot.name, place))) continue;
      polygon(c, to, robot.robot.footprint.map((p) => worldPoint(place, p)));
      this.finishObject(c, to, place, robot.name, isSecond);
    }
    c.setLineDash([]);
    if (isSecond) return;
    world.frames.forEach((frame, i) => {
      const pose = frame.declared && i > 0 ? frameInWorld(world, i, now) : null;
      if (pose) this.drawFrame(c, to, pose.p, Math.atan2(pose.r[3]!, pose.r[0]!), frame.name);
    });
  }

  /** Of one that leans: where it is at the height at which the base meets it. */
  private outline(c: CanvasRenderingContext2D, to: ToPixels, object: SceneObject, place: Place, s: number, height: number): void {
    if (object.shape !== 'cylinder') return polygon(c, to, outlinesOf(object, place, height).met);
    c.beginPath();
    c.arc(...to([place.x, place.y]), object.size[0]! * s, 0, 2 * Math.PI);
  }

  /** What is seen of a leaning object from above, beyond what a base meets. */
  private drawSeen(c: CanvasRenderingContext2D, to: ToPixels, object: SceneObject, place: Place): void {
    polygon(c, to, outlinesOf(object, place, 0).seen);
    c.setLineDash([2, 4]);
    c.stroke();
    c.setLineDash([]);
  }

  /** Where an object goes when the pointer lets go. */
  private drawGhost(c: CanvasRenderingContext2D, to: ToPixels): void {
    const ghost = this.grip?.ghost;
    if (!ghost) return;
    this.outline(c, to, ghost.object, ghost.place, this.pixels(), 0);
    c.setLineDash([3, 4]);
    c.strokeStyle = ofStyle('--link');
    c.lineWidth = 2;
    c.stroke();
    c.setLineDash([]);
  }

  private hasAlready(name: string, place: Place): boolean {
    const { run, world } = this.viewed[0]!;
    const time = Math.min(this.clock.time, run.duration);
    const object = world.scene?.objects.find((one) => one.name === name);
    const robot = world.scene?.robots.find((one) => one.name === name);
    const first = object ? placeOf(run, object, time) : robot ? placeOf(run, { ...robot, shape: 'box', size: [], moves: true }, time) : null;
    return first !== null && Math.hypot(first.x - place.x, first.y - place.y) < 1e-3 && Math.abs(first.yaw - place.yaw) < 1e-3;
  }

  private finishObject(c: CanvasRenderingContext2D, to: ToPixels, place: Place, name: string, isSecond: boolean): void {
    c.fillStyle = ofStyle('--object');
    c.strokeStyle = ofStyle('--ink');
    c.lineWidth = 1;
    if (!isSecond) c.fill();
    c.stroke();
    const text = isSecond ? `${name} (${this.viewed[1]!.letter})` : name;
    this.labels.push({ text, at: to([place.x, place.y]), style: ofStyle('--ink') });
  }

  private drawFrame(c: CanvasRenderingContext2D, to: ToPixels, p: Point, yaw: number, name: string): void {
    const [x, y] = to(p);
    for (const [turn, name_, style] of [[0, 'x', '--x'], [Math.PI / 2, 'y', '--y']] as const) {
      c.strokeStyle = ofStyle(style);
      c.lineWidth = 2;
      const [ex, ey] = [x + 22 * Math.cos(yaw + turn), y - 22 * Math.sin(yaw + turn)];
      c.beginPath();
      c.moveTo(x, y);
      c.lineTo(ex, ey);
      c.stroke();
      this.labels.unshift({ text: name_, at: [ex - 3, ey + 12], style: ofStyle(style) });
    }
    this.labels.push({ text: name, at: [x, y + 12], style: ofStyle('--quiet') });
  }

  private drawPath(c: CanvasRenderingContext2D, to: ToPixels, { run }: Viewed, path: Point[], i: number): void {
    const passed = Math.floor((Math.min(1, this.clock.time / run.duration)) * (path.length - 1));
    const look = looks[i]!;
    c.setLineDash(look.dashes);
    for (const [from, until, style, width] of [[0, path.length, i ? look.style : '--grid-strong', 1], [0, passed + 1, look.style, 2]] as const) {
      c.beginPath();
      path.slice(from, until).forEach((p, k) => (k ? c.lineTo(...to(p)) : c.moveTo(...to(p))));
      c.strokeStyle = ofStyle(style);
      c.lineWidth = width;
      c.stroke();
    }
    c.setLineDash([]);
  }

  private drawRobot(c: CanvasRenderingContext2D, to: ToPixels, { world, letter }: Viewed, now: Instant, i: number): void {
    const robot = world.robot;
    const look = looks[i]!;
    // Of two runs the dashes tell the second.
    if (now.believed && this.viewed.length === 1) {
      polygon(c, to, robot.footprint.map((p) => worldPoint(now.believed!, p)));
      c.setLineDash([4, 4]);
      c.strokeStyle = ofStyle('--quiet');
      c.stroke();
      c.setLineDash([]);
    }
    polygon(c, to, robot.footprint.map((p) => worldPoint(now.base, p)));
    c.fillStyle = ofStyle(look.fill);
    c.strokeStyle = ofStyle(look.style);
    c.lineWidth = 2;
    c.setLineDash(look.dashes);
    c.fill();
    c.stroke();
    c.setLineDash([]);
    for (const wheel of robot.wheels) {
      const pose = now.bodies[wheel.body]!;
      // The wheel rolls across its axle, which lies in the plane.
      const axis = robot.bodies[wheel.body]!.axis;
      const axle = [0, 1].map((i) => [0, 1, 2].reduce((sum, k) => sum + pose.r[3 * i + k]! * axis[k]!, 0));
      const length = Math.hypot(axle[0]!, axle[1]!) || 1;
      const [ux, uy] = [-axle[1]! / length, axle[0]! / length];
      const half = wheel.radius * 0.3;
      const corner = (a: number, b: number): Point => [pose.p[0]! + a * ux - b * uy, pose.p[1]! + a * uy + b * ux];
      polygon(c, to, [corner(wheel.radius, half), corner(-wheel.radius, half), corner(-wheel.radius, -half), corner(wheel.radius, -half)]);
      c.fillStyle = ofStyle('--ink');
      c.fill();
    }
    robot.bodies.forEach((body, i) => {
      if (body.parent < 0 || robot.wheels.some((wheel) => wheel.body === i)) return;
      c.beginPath();
      c.moveTo(...to(now.bodies[body.parent]!.p));
      c.lineTo(...to(now.bodies[i]!.p));
      c.strokeStyle = ofStyle('--link');
      c.lineWidth = 4;
      c.stroke();
    });
    const nose = Math.max(...robot.footprint.map((p) => p[0]!), 0.1);
    this.arrow(c, to([now.base.x, now.base.y]), to(worldPoint(now.base, [nose, 0])), ofStyle(look.style));
    const [x, y] = to(worldPoint(now.base, [-0.5 * nose, 0]));
    if (letter) this.labels.unshift({ text: letter, at: [x - 11, y + (i ? 20 : -8)], style: ofStyle('--ink'), font: 'bold 16px system-ui, sans-serif' });
  }

  private drawForces(c: CanvasRenderingContext2D, to: ToPixels, { run, world, letter }: Viewed, now: Instant): void {
    for (const contact of contactsAt(run, world, now)) {
      const [x, y] = to(contact.at);
      // A length that grows as the logarithm: 1 N is seen, 1 kN stays on the page.
      const length = 18 * Math.log10(1 + contact.force * 2);
      const tip: [number, number] = [x + contact.normal[0] * length, y - contact.normal[1] * length];
      this.arrow(c, [x, y], tip, ofStyle('--force'));
      this.labels.unshift({ text: withUnit(contact.force, 'N') + (letter ? ` (${letter})` : ''), at: tip, style: ofStyle('--force') });
    }
  }

  /** The push of the pointer, and the one that the log has at this time. */
  private drawHand(c: CanvasRenderingContext2D, to: ToPixels, now: Instant): void {
    this.drawGhost(c, to);
    const pulled = this.pusher?.arrow;
    const push = pulled ?? pushAt(this.viewed[0]!.run, now);
    if (!push) return;
    const [from, tip] = [to(push.from), to(push.to)];
    this.arrow(c, from, tip, ofStyle('--link'));
    this.labels.unshift({ text: `${withUnit(Math.hypot(...push.force), 'N')} by hand`, at: tip, style: ofStyle('--link') });
  }

  private arrow(c: CanvasRenderingContext2D, from: [number, number], tip: [number, number], style: string): void {
    const angle = Math.atan2(tip[1] - from[1], tip[0] - from[0]);
    c.strokeStyle = style;
    c.fillStyle = style;
    c.lineWidth = 3;
    c.beginPath();
    c.moveTo(...from);
    c.lineTo(...tip);
    c.stroke();
    c.beginPath();
    c.moveTo(...tip);
    c.lineTo(tip[0] - 9 * Math.cos(angle - 0.45), tip[1] - 9 * Math.sin(angle - 0.45));
    c.lineTo(tip[0] - 9 * Math.cos(angle + 0.45), tip[1] - 9 * Math.sin(angle + 0.45));
    c.closePath();
    c.fill();
  }
}
