// The top view: robot, scene, regions, frames and forces, drawn in the plane.
import type { Clock } from './clock';
import { ofStyle, onScheme } from './colours';
import type { Run, World } from './data';
import { h } from './dom';
import { withUnit } from './units';
import { contactsAt, cornersOf, extentOf, frameInWorld, instantAt, outlineOf, placeOf, worldPoint, type Instant } from './world';

type Point = number[];

export class TopView {
  readonly element: HTMLElement;
  follow = false;
  private readonly canvas = h('canvas', { class: 'view', tabindex: 0, role: 'img' });
  private scale = 100;
  private centre: Point = [0, 0];
  private zoom = 1;
  private readonly path: Point[] = [];

  constructor(private readonly run: Run, private readonly world: World, private readonly clock: Clock) {
    this.element = h('figure', {}, this.canvas, h('figcaption', {}, 'From above. Wheel or + and - zoom, a drag moves. Dashed: where zwang has the base.'));
    const [x, y] = [run.sample('truth.base.x') ?? run.sample('base.x'), run.sample('truth.base.y') ?? run.sample('base.y')];
    for (let i = 0; x && y && i < x.length; ++i) {
      if (Number.isFinite(x[i]! + y[i]!)) this.path.push([x[i]!, y[i]!]);
    }
    this.fit();
    clock.onTime(() => this.draw());
    onScheme(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.setZoom(this.zoom * Math.exp(-event.deltaY / 400));
    }, { passive: false });
    this.canvas.addEventListener('keydown', (event) => {
      if (event.key === '+') this.setZoom(this.zoom * 1.25);
      if (event.key === '-') this.setZoom(this.zoom / 1.25);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.buttons !== 1) return;
      this.centre = [this.centre[0]! - event.movementX / this.pixels(), this.centre[1]! + event.movementY / this.pixels()];
      this.draw();
    });
  }

  setZoom(zoom: number): void {
    this.zoom = Math.min(40, Math.max(0.2, zoom));
    this.draw();
  }

  private fit(): void {
    const [low, high] = extentOf(this.run, this.world);
    this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    this.scale = 1.15 * Math.max(high[0] - low[0], high[1] - low[1]);
  }

  private pixels(): number {
    return (Math.min(this.canvas.clientWidth, this.canvas.clientHeight) / this.scale) * this.zoom;
  }

  draw(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = devicePixelRatio || 1;
    if (width === 0) return;
    if (this.canvas.width !== Math.round(width * ratio)) this.canvas.width = Math.round(width * ratio);
    if (this.canvas.height !== Math.round(height * ratio)) this.canvas.height = Math.round(height * ratio);
    const c = this.canvas.getContext('2d')!;
    const now = instantAt(this.run, this.world.robot, this.clock.time);
    const centre = this.follow ? [now.base.x, now.base.y] : this.centre;
    const s = this.pixels();
    const to = (p: Point): [number, number] => [width / 2 + (p[0]! - centre[0]!) * s, height / 2 - (p[1]! - centre[1]!) * s];
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    c.font = '12px system-ui, sans-serif';
    this.drawGrid(c, to, s, width, height, centre);
    this.drawScene(c, to, now, s);
    this.drawPath(c, to, now);
    this.drawRobot(c, to, now, s);
    this.drawForces(c, to, now, s);
    this.canvas.setAttribute('aria-label', `Top view at ${now.time.toFixed(3)} s: base at x ${now.base.x.toFixed(3)} m, ` +
      `y ${now.base.y.toFixed(3)} m, heading ${withUnit(now.base.yaw, 'rad')}`);
    this.canvas.dataset.pose = [now.base.x, now.base.y, now.base.yaw].join(' ');
  }

  private drawGrid(c: CanvasRenderingContext2D, to: (p: Point) => [number, number], s: number, width: number, height: number, centre: Point): void {
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
    c.fillStyle = ofStyle('--quiet');
    c.fillText(`grid ${step} m`, 8, height - 8);
  }

  private polygon(c: CanvasRenderingContext2D, to: (p: Point) => [number, number], points: Point[]): void {
    c.beginPath();
    points.forEach((p, i) => (i ? c.lineTo(...to(p)) : c.moveTo(...to(p))));
    c.closePath();
  }

  private drawScene(c: CanvasRenderingContext2D, to: (p: Point) => [number, number], now: Instant, s: number): void {
    for (const region of this.world.regions) {
      const corners = cornersOf(this.world, region, now);
      if (!corners) continue;
      this.polygon(c, to, corners);
      c.strokeStyle = ofStyle('--region');
      c.setLineDash([10, 5]);
      c.lineWidth = 2;
      c.stroke();
      c.setLineDash([]);
      c.fillStyle = ofStyle('--region');
      const [x, y] = to(corners[0]!);
      c.fillText(region.name, x + 4, y - 4);
    }
    for (const object of this.world.scene?.objects ?? []) {
      const place = placeOf(this.run, object, now.time);
      if (object.shape === 'cylinder') {
        c.beginPath();
        c.arc(...to([place.x, place.y]), object.size[0]! * s, 0, 2 * Math.PI);
      } else {
        this.polygon(c, to, outlineOf(object).map((p) => worldPoint(place, p)));
      }
      c.fillStyle = ofStyle('--object');
      c.strokeStyle = ofStyle('--ink');
      c.lineWidth = 1;
      c.fill();
      c.stroke();
      c.fillStyle = ofStyle('--ink');
      const [x, y] = to([place.x, place.y]);
      c.fillText(object.name, x + 6, y - 6);
    }
    for (const robot of this.world.scene?.robots ?? []) {
      const place = placeOf(this.run, { ...robot, shape: 'box', size: [], moves: true }, now.time);
      if (!robot.robot) continue;
      this.polygon(c, to, robot.robot.footprint.map((p) => worldPoint(place, p)));
      c.fillStyle = ofStyle('--object');
      c.fill();
      c.stroke();
      c.fillStyle = ofStyle('--ink');
      c.fillText(robot.name, ...to([place.x, place.y]));
    }
    this.world.frames.forEach((frame, i) => {
      const pose = frame.declared && i > 0 ? frameInWorld(this.world, i, now) : null;
      if (pose) this.drawFrame(c, to, pose.p, Math.atan2(pose.r[3]!, pose.r[0]!), frame.name);
    });
  }

  private drawFrame(c: CanvasRenderingContext2D, to: (p: Point) => [number, number], p: Point, yaw: number, name: string): void {
    const [x, y] = to(p);
    for (const [turn, name_, style] of [[0, 'x', '--x'], [Math.PI / 2, 'y', '--y']] as const) {
      c.strokeStyle = ofStyle(style);
      c.fillStyle = ofStyle(style);
      c.lineWidth = 2;
      const [ex, ey] = [x + 22 * Math.cos(yaw + turn), y - 22 * Math.sin(yaw + turn)];
      c.beginPath();
      c.moveTo(x, y);
      c.lineTo(ex, ey);
      c.stroke();
      c.fillText(name_, ex + 2, ey);
    }
    c.fillStyle = ofStyle('--quiet');
    c.fillText(name, x + 4, y + 14);
  }

  private drawPath(c: CanvasRenderingContext2D, to: (p: Point) => [number, number], now: Instant): void {
    const passed = Math.floor((now.time / this.run.duration) * (this.path.length - 1));
    for (const [from, until, style, width] of [[0, this.path.length, '--grid-strong', 1], [0, passed + 1, '--accent', 2]] as const) {
      c.beginPath();
      this.path.slice(from, until).forEach((p, i) => (i ? c.lineTo(...to(p)) : c.moveTo(...to(p))));
      c.strokeStyle = ofStyle(style);
      c.lineWidth = width;
      c.stroke();
    }
  }

  private drawRobot(c: CanvasRenderingContext2D, to: (p: Point) => [number, number], now: Instant, s: number): void {
    const robot = this.world.robot;
    if (now.believed) {
      this.polygon(c, to, robot.footprint.map((p) => worldPoint(now.believed!, p)));
      c.setLineDash([4, 4]);
      c.strokeStyle = ofStyle('--quiet');
      c.stroke();
      c.setLineDash([]);
    }
    this.polygon(c, to, robot.footprint.map((p) => worldPoint(now.base, p)));
    c.fillStyle = ofStyle('--robot');
    c.strokeStyle = ofStyle('--accent');
    c.lineWidth = 2;
    c.fill();
    c.stroke();
    for (const wheel of robot.wheels) {
      const pose = now.bodies[wheel.body]!;
      // The wheel rolls across its axle, which lies in the plane.
      const axis = robot.bodies[wheel.body]!.axis;
      const axle = [0, 1].map((i) => [0, 1, 2].reduce((sum, k) => sum + pose.r[3 * i + k]! * axis[k]!, 0));
      const length = Math.hypot(axle[0]!, axle[1]!) || 1;
      const [ux, uy] = [-axle[1]! / length, axle[0]! / length];
      const half = wheel.radius * 0.3;
      const corner = (a: number, b: number): Point => [pose.p[0]! + a * ux - b * uy, pose.p[1]! + a * uy + b * ux];
      this.polygon(c, to, [corner(wheel.radius, half), corner(-wheel.radius, half), corner(-wheel.radius, -half), corner(wheel.radius, -half)]);
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
    this.arrow(c, to([now.base.x, now.base.y]), to(worldPoint(now.base, [nose, 0])), ofStyle('--accent'));
    void s;
  }

  private drawForces(c: CanvasRenderingContext2D, to: (p: Point) => [number, number], now: Instant, s: number): void {
    void s;
    for (const contact of contactsAt(this.run, this.world, now)) {
      const [x, y] = to(contact.at);
      // A length that grows as the logarithm: 1 N is seen, 1 kN stays on the page.
      const length = 18 * Math.log10(1 + contact.force * 2);
      const tip: [number, number] = [x + contact.normal[0] * length, y - contact.normal[1] * length];
      this.arrow(c, [x, y], tip, ofStyle('--force'));
      c.fillStyle = ofStyle('--force');
      c.fillText(withUnit(contact.force, 'N'), tip[0] + 5, tip[1] - 5);
    }
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
