// The same in space, by three.
import * as three from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Clock } from './clock';
import { ofStyle, onScheme } from './colours';
import type { Pose, Robot, Run, SceneObject, World } from './data';
import { h, sizeOf } from './dom';
import { baseAt, heightOf } from './motion';
import { Pace } from './pace';
import { contactsAt, cornersOf, extentOf, forceLength, frameInWorld, instantAt, placeOf, type Instant } from './world';

function put(object: three.Object3D, pose: Pose): void {
  const [a, b, c, d, e, f, g, i, j] = pose.r as [number, number, number, number, number, number, number, number, number];
  object.matrixAutoUpdate = false;
  object.matrix.set(a, b, c, pose.p[0]!, d, e, f, pose.p[1]!, g, i, j, pose.p[2]!, 0, 0, 0, 1);
  object.matrixWorldNeedsUpdate = true;
}

/** Ends when the pixels are there: to render is only to ask for them. */
function painted(gl: WebGL2RenderingContext): Promise<void> {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  return new Promise((resolve) => {
    const look = (): void => {
      if (fence && !gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) return void setTimeout(look, 2);
      gl.deleteSync(fence);
      resolve();
    };
    look();
  });
}

export class SpaceView {
  readonly element: HTMLElement;
  follow = false;
  private readonly canvas = h('canvas', { class: 'view', tabindex: 0, role: 'img', 'aria-label': 'The robot and its scene in space' });
  private readonly size = sizeOf(this.canvas, () => this.draw());
  private renderer: three.WebGLRenderer | null = null;
  private readonly scene = new three.Scene();
  private readonly camera = new three.PerspectiveCamera(45, 1, 0.01, 500);
  private controls: OrbitControls | null = null;
  private pace: Pace | null = null;
  private readonly bodies: three.Object3D[] = [];
  private readonly movers: ((now: Instant) => void)[] = [];
  private readonly arrows = new three.Group();
  private readonly path = new three.Line(new three.BufferGeometry(), new three.LineBasicMaterial({ color: '#0b62c4' }));
  private pathSamples = 0;
  private readonly target = new three.Vector3();

  constructor(private readonly run: Run, private readonly world: World, private readonly clock: Clock) {
    this.element = h('figure', {}, this.canvas, h('figcaption', {}, 'In space. A drag turns, the wheel zooms, a drag with the right button moves.'));
  }

  /** Apart from the page's opening: without a graphics card it takes seconds. */
  start(): void {
    try {
      this.renderer = new three.WebGLRenderer({ canvas: this.canvas, antialias: false });
    } catch {
      this.element.replaceChildren(h('p', { class: 'note' }, 'This browser has no WebGL: the view from above shows the same.'));
      return;
    }
    this.build();
    this.look();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target.copy(this.target);
    this.controls.update();
    this.pace = new Pace(this.canvas, (ratio) => this.drawAt(ratio));
    this.controls.addEventListener('change', () => this.draw());
    this.clock.onTime(() => this.draw());
    onScheme(() => this.draw());
    this.draw();
  }

  private material(colour: string, opacity = 1): three.MeshLambertMaterial {
    return new three.MeshLambertMaterial({ color: colour, transparent: opacity < 1, opacity });
  }

  private build(): void {
    this.camera.up.set(0, 0, 1);
    this.scene.add(new three.HemisphereLight('#ffffff', '#667788', 2.2));
    const sun = new three.DirectionalLight('#ffffff', 1.6);
    sun.position.set(3, -4, 8);
    this.scene.add(sun);
    const grid = new three.GridHelper(40, 80, '#8a94a6', '#b8c0cc');
    grid.rotateX(Math.PI / 2);
    grid.position.z = -0.001;
    (grid.material as three.Material).transparent = true;
    (grid.material as three.Material).opacity = 0.35;
    this.scene.add(grid, this.arrows);
    this.buildRobot(this.world.robot);
    for (const object of this.world.scene?.objects ?? []) this.buildObject(object);
    for (const other of this.world.scene?.robots ?? []) {
      if (!other.robot) continue;
      const mesh = this.prism(other.robot, '#8d6e4f', 0.9);
      this.scene.add(mesh);
      this.movers.push((now) => this.place(mesh, placeOf(this.run, { ...other, shape: 'box', size: [], moves: true }, now.time)));
    }
    this.path.geometry = this.pathGeometry();
    this.scene.add(this.path);
    for (const region of this.world.regions) {
      const line = new three.LineLoop(new three.BufferGeometry(), new three.LineBasicMaterial({ color: '#b07400' }));
      this.scene.add(line);
      this.movers.push((now) => {
        const corners = cornersOf(this.world, region, now);
        if (corners) line.geometry.setFromPoints(corners.map((p) => new three.Vector3(p[0], p[1], 0.01)));
      });
    }
    this.world.frames.forEach((frame, i) => {
      if (!frame.declared || i === 0) return;
      const axes = new three.AxesHelper(0.2);
      this.scene.add(axes);
      this.movers.push((now) => {
        const pose = frameInWorld(this.world, i, now);
        axes.visible = pose !== null;
        if (pose) put(axes, pose);
      });
    });
  }

  private place(object: three.Object3D, place: { x: number; y: number; yaw: number }): void {
    object.position.set(place.x, place.y, object.position.z);
    object.rotation.z = place.yaw;
  }

  /** The footprint as a prism between the floor's clearance and a hand above the bumper. */
  private prism(robot: Robot, colour: string, opacity: number): three.Mesh {
    const shape = new three.Shape(robot.footprint.map((p) => new three.Vector2(p[0], p[1])));
    const geometry = new three.ExtrudeGeometry(shape, { depth: Math.max(0.06, robot.height * 1.3 - 0.04), bevelEnabled: false });
    const mesh = new three.Mesh(geometry, this.material(colour, opacity));
    mesh.position.z = 0.04;
    return mesh;
  }

  private buildRobot(robot: Robot): void {
    const base = this.prism(robot, '#2f7de1', 0.55);
    base.position.z = 0.04 - heightOf(robot);
    robot.bodies.forEach((body, i) => {
      const group = new three.Group();
      const wheel = robot.wheels.find((one) => one.body === i);
      if (wheel) {
        const width = wheel.radius * 0.6;
        const tyre = new three.Mesh(new three.CylinderGeometry(wheel.radius, wheel.radius, width, 28), this.material('#23272f'));
        const spoke = new three.Mesh(new three.BoxGeometry(wheel.radius * 1.7, width * 1.04, wheel.radius * 0.2), this.material('#e8eaee'));
        const axle = new three.Group().add(tyre, spoke);
        axle.quaternion.setFromUnitVectors(new three.Vector3(0, 1, 0), new three.Vector3(...(body.axis as [number, number, number])));
        group.add(axle);
      } else if (body.parent < 0) {
        group.add(base);
      } else {
        const [x, y, z] = body.box.sides as [number, number, number];
        const box = new three.Mesh(new three.BoxGeometry(x, y, z), this.material('#d9822b'));
        put(box, body.box.pose);
        group.add(box);
      }
      this.bodies.push(group);
      this.scene.add(group);
    });
  }

  private buildObject(object: SceneObject): void {
    const [a, b, c] = object.size as [number, number, number];
    const geometry = object.shape === 'cylinder' ? new three.CylinderGeometry(a, a, c, 36).rotateX(Math.PI / 2)
      : object.shape === 'wall' ? new three.BoxGeometry(b, a, c).translate(b / 2, 0, 0) : new three.BoxGeometry(a, b, c);
    const mesh = new three.Mesh(geometry, this.material('#9aa5b5', object.shape === 'wall' ? 0.75 : 0.95));
    if (object.lean) {
      mesh.geometry.translate(0, 0, c / 2);
      put(mesh, object.lean);
      this.scene.add(mesh);
      return;
    }
    mesh.position.z = c / 2;
    this.scene.add(mesh);
    this.movers.push((now) => this.place(mesh, placeOf(this.run, object, now.time)));
  }

  /** The run has grown; drawn with the next time. */
  grow(): void {
    const count = this.run.sampleTimes.length;
    // A hundredth more shows no difference.
    if (!this.renderer || count < 1.01 * this.pathSamples) return;
    this.pathSamples = count;
    this.path.geometry.dispose();
    this.path.geometry = this.pathGeometry();
  }

  private pathGeometry(): three.BufferGeometry {
    const points: three.Vector3[] = [];
    for (const time of this.run.sampleTimes) {
      const base = baseAt(this.run, time);
      const point = new three.Vector3(base.x, base.y, 0.004);
      if (!points.length || point.distanceTo(points.at(-1)!) > 1e-3) points.push(point);
    }
    return new three.BufferGeometry().setFromPoints(points);
  }

  private look(): void {
    const [low, high] = extentOf(this.run, this.world);
    this.target.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0);
    const size = 1.6 * Math.hypot(high[0] - low[0], high[1] - low[1]);
    this.camera.position.set(this.target.x - 0.55 * size, this.target.y - 0.55 * size, 0.6 * size);
  }

  /** At the next frame that the machine has time for. */
  draw(): void {
    this.pace?.want();
  }

  private async drawAt(ratio: number): Promise<void> {
    if (!this.renderer) return;
    const [width, height] = this.size();
    if (width === 0) return;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
    }
    const now = instantAt(this.run, this.world.robot, this.clock.time);
    this.bodies.forEach((body, i) => put(body, now.bodies[i]!));
    for (const move of this.movers) move(now);
    this.arrows.clear();
    for (const contact of contactsAt(this.run, this.world, now)) {
      const direction = new three.Vector3(contact.normal[0], contact.normal[1], 0);
      this.arrows.add(new three.ArrowHelper(direction, new three.Vector3(...contact.at, this.world.robot.height), forceLength(contact.force), '#c62828', 0.12, 0.08));
    }
    if (this.follow && this.controls) {
      const step = new three.Vector3(now.base.x, now.base.y, 0).sub(this.controls.target);
      this.camera.position.add(step);
      this.controls.target.add(step);
      this.controls.update();
    }
    this.canvas.dataset.pose = [now.base.x, now.base.y, now.base.yaw].join(' ');
    this.canvas.dataset.ratio = String(ratio);
    this.scene.background = new three.Color(ofStyle('--view'));
    this.renderer.render(this.scene, this.camera);
    await painted(this.renderer.getContext() as WebGL2RenderingContext);
  }
}
