// The scene in three.js: the shape, the ghost of the target, marks of selected and held parts, the camera.
//
// Nothing is drawn unless something has changed. The camera moves when the user moves it, and when a window shows its
// first content or another model; and once more for the first shape of a model that does not fit into the view, where the
// user has not moved it and draws nothing over it. Never because of a later search, a reload or an undo.

import {
  AmbientLight,
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  EdgesGeometry,
  Group,
  HemisphereLight,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
  Material,
  Mesh,
  MeshBasicMaterial,
  PCFShadowMap,
  PerspectiveCamera,
  Plane,
  PlaneGeometry,
  Raycaster,
  Scene,
  ShadowMaterial,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Arrow, Ask, AskChange, Difference, Eye, Shape, TargetAsk } from "../messages";
import { cubes, KINDS, sheet, tiles } from "./cells";
import { arrowMeshes } from "./arrows";
import { solid } from "./finish";
import { frame, isSeen } from "./framing";
import { type Order, sorted } from "./growth";
import { subset, triangle, unpacked } from "./meshes";
import { kindOf, type Mode, Things } from "./things";
import type { Piece } from "./meshes";

export const COLORS = {
  light: { paper: 0xf3f1ec, ghost: 0x5a82b8, obstacle: 0xb4564a, mark: 0x8a857a, selected: 0xd0652b, held: 0x2f6f8f, shade: 0.16, falling: 0xb3261e, force: 0x1f5f8b },
  dark: { paper: 0x1d1e21, ghost: 0x7fa3d4, obstacle: 0xd9837a, mark: 0x8c8d92, selected: 0xf08a4b, held: 0x6fb2d2, shade: 0.45, falling: 0xff6b5e, force: 0x8cc8f0 },
};

export class Stage {
  readonly camera = new PerspectiveCamera(32, 1, 0.05, 5000);
  readonly scene = new Scene();
  piece: Piece | null = null;
  private readonly renderer: WebGLRenderer;
  private readonly orbit: OrbitControls;
  readonly things: Things;
  private readonly sun = new DirectionalLight(0xfff9ef, 2.3);
  private readonly ground: Mesh;
  private readonly shape = new Group();
  private readonly marks = new Group();
  private readonly line = new Group();
  readonly arrows = new Group();
  private differences = new Group();
  private ends: { order: Order; at: Uint32Array } | null = null;
  private sides: Group[] = [];
  private ghostBox = new Box3();
  private ask: Ask = {};
  private look = COLORS.light;
  private theme: "light" | "dark" = "light";
  /** Materials that keep their programs compiled. */
  readonly kept: Material[];
  private isAsked = false;
  private isFramed = false;
  /** The first shape of the model has come, or the user has moved the camera. */
  private isSettled = false;
  /** Pixels may be drawn again. */
  frames = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    onPlaced: (change: AskChange) => void,
    private readonly onLook: () => void,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.ground = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ opacity: 0.16 }));
    this.ground.rotation.x = -Math.PI / 2;
    this.ground.receiveShadow = true;
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 7;
    this.sun.shadow.bias = -0.0004;
    this.scene.add(
      new HemisphereLight(0xffffff, 0xdedad2, 1.75),
      new AmbientLight(0xffffff, 0.25),
      this.sun,
      this.sun.target,
      this.ground,
      this.shape,
      this.marks,
      this.line,
      this.arrows,
      this.differences,
    );
    this.camera.position.set(14, 9, 18);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = false;
    this.orbit.addEventListener("start", () => (this.isSettled = true));
    this.orbit.addEventListener("change", () => {
      this.draw();
      this.onLook();
    });
    const dragging = (isDragging: boolean) => (this.orbit.enabled = !isDragging);
    this.things = new Things(this.camera, canvas, onPlaced, dragging, () => this.draw());
    this.scene.add(this.things.group, this.things.handles.getHelper());
    this.paint("light");
    this.kept = this.warm();
  }

  /**
   * Compile what is drawn with before it is wanted. The materials are kept: what no material uses is compiled again,
   * and that takes longer than a frame.
   */
  private warm(): Material[] {
    const glass = { transparent: true, opacity: 0.5 };
    const [fill, line] = [new MeshBasicMaterial(glass), new LineBasicMaterial(glass)];
    const meshes = [solid(true), solid(false), tiles(), fill].map((one) => new Mesh(triangle(), one));
    for (const mesh of meshes) mesh.castShadow = mesh.receiveShadow = mesh.material !== fill;
    const all = [...meshes, new LineSegments(triangle(), line)];
    this.shape.add(...all);
    this.renderer.render(this.scene, this.camera);
    this.shape.clear();
    for (const one of all) one.geometry.dispose();
    return all.map((one) => one.material);
  }

  /** Draw with the next frame. */
  draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.frames++;
      if (this.sides.length === 0) this.renderer.render(this.scene, this.camera);
      else this.drawSides();
    });
  }

  /** Several shapes side by side, seen by the same camera; none of them shows the one shape again. */
  setSides(shapes: [Shape, ArrayBuffer][]): void {
    for (const one of this.sides) clear(one);
    this.scene.remove(...this.sides);
    this.sides = shapes.map(([header, payload]) => {
      const group = new Group();
      if (header.triangles > 0) group.add(this.meshOf(unpacked(header, payload)));
      return group;
    });
    if (this.sides.length > 0) this.scene.add(...this.sides);
    this.shape.visible = this.marks.visible = this.sides.length === 0;
    this.aspect();
    this.draw();
  }

  /** Triangles of what stands side by side. */
  get compared(): number[] {
    return this.sides.map((one) => ((one.children[0] as Mesh)?.geometry.index?.count ?? 0) / 3);
  }

  private drawSides(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const edge = (k: number) => Math.round((k * clientWidth) / this.sides.length);
    this.renderer.setScissorTest(true);
    this.sides.forEach((_, k) => {
      this.sides.forEach((one, other) => (one.visible = other === k));
      this.renderer.setViewport(edge(k), 0, edge(k + 1) - edge(k), clientHeight);
      this.renderer.setScissor(edge(k), 0, edge(k + 1) - edge(k), clientHeight);
      this.renderer.render(this.scene, this.camera);
    });
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, clientWidth, clientHeight);
  }

  /** The camera's view is as wide as one of those that stand side by side. */
  private aspect(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.camera.aspect = clientWidth / Math.max(this.sides.length, 1) / Math.max(clientHeight, 1);
    // What was seen across the whole width is seen across the narrower one.
    this.camera.zoom = 1 / Math.max(this.sides.length, 1);
    this.camera.updateProjectionMatrix();
  }

  resize(width: number, height: number): void {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.aspect();
    this.draw();
  }

  paint(theme: "light" | "dark"): void {
    this.theme = theme;
    this.look = COLORS[theme];
    this.scene.background = new Color(this.look.paper);
    (this.ground.material as ShadowMaterial).opacity = this.look.shade;
    this.things.paint(this.look);
    this.draw();
  }

  // ---- content

  /** Show a shape; an empty payload takes it away. */
  show(header: Shape | null, payload: ArrayBuffer): void {
    clear(this.shape);
    this.piece = null;
    this.ends = null;
    if (header !== null && header.triangles > 0) {
      this.piece = unpacked(header, payload);
      this.shape.add(this.meshOf(this.piece));
    }
    this.come();
  }

  private meshOf({ header, geometry }: Piece): Mesh {
    const material = header.is_flat
      ? new MeshBasicMaterial({ vertexColors: true })
      : solid(header.detail !== "fine");
    const mesh = new Mesh(geometry, material);
    mesh.castShadow = mesh.receiveShadow = !header.is_flat;
    return mesh;
  }

  /** Show the first parts of the shape in an order; all of them where there is no count. */
  setGrowth(count: number | null, order: Order, emitted: string[]): void {
    if (this.piece === null) return;
    if (count === null) this.piece.geometry.setDrawRange(0, Infinity);
    else {
      if (this.ends === null || this.ends.order !== order) this.ends = { order, at: sorted(this.piece, order, emitted) };
      this.piece.geometry.setDrawRange(0, 3 * this.ends.at[Math.min(count, this.ends.at.length - 1)]);
    }
    this.marks.visible = this.shape.visible && count === null;
    this.draw();
  }

  /** Show the target or an obstacle where it is placed. */
  setSolid(name: string, header: Shape, payload: ArrayBuffer, asked: TargetAsk | null): void {
    this.things.setSolid(name, header, payload, asked);
    if (kindOf(name) === "target") {
      this.ghostBox.makeEmpty();
      if (header.triangles > 0) this.ghostBox.set(new Vector3(...header.low), new Vector3(...header.high));
    }
    this.come();
  }

  /** What is asked, apart from solids: floor, light and camera. */
  setAsk(ask: Ask): void {
    this.ask = ask;
    this.settle();
    this.draw();
  }

  setGhostVisible(isVisible: boolean): void {
    this.things.setGhostVisible(isVisible);
    this.draw();
  }

  /** Show where the scene differs from what is wanted in its place, or the scene itself. */
  setDifference(header: Difference | null, marks: Uint8Array): void {
    clear(this.differences);
    this.scene.remove(this.differences);
    const isSeen = header?.is_picture === true && header.low[0] === header.high[0];
    if (header !== null && !isSeen) {
      this.differences = (header.is_picture ? sheet : cubes)(header, marks, KINDS[this.theme]);
      this.scene.add(this.differences);
    }
    const hides = header !== null && !header.is_picture;
    this.shape.visible = this.marks.visible = !hides;
    this.draw();
  }

  /** Mark parts: those that are selected or under the pointer, and those that are held. */
  mark(
    isSelected: (address: string) => boolean,
    isHeld: (address: string) => boolean,
    isFalling: (address: string) => boolean,
  ): void {
    clear(this.marks);
    if (this.piece !== null && !this.piece.header.is_flat) {
      this.tint(isFalling, this.look.falling, 0.5);
      this.tint(isHeld, this.look.held, 0.28);
      this.tint(isSelected, this.look.selected, 0.35);
    }
    this.draw();
  }

  /** Show forces, as long as a fifth of the scene where they are largest. */
  setArrows(forces: Arrow[]): void {
    clear(this.arrows);
    const size = this.bounds().getSize(new Vector3()).length();
    for (const one of arrowMeshes(forces, 0.2 * size, this.look.force)) this.arrows.add(one);
    this.draw();
  }

  private tint(isIn: (address: string) => boolean, color: number, opacity: number): void {
    const geometry = subset(this.piece!, isIn);
    if (geometry === null) return;
    const near = { polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 };
    const fill = new MeshBasicMaterial({ color, transparent: true, opacity, depthWrite: false, ...near });
    const line = new LineBasicMaterial({ color, transparent: true, opacity: 0.9 });
    this.marks.add(new Mesh(geometry, fill), new LineSegments(new EdgesGeometry(compact(geometry), 30), line));
  }

  // ---- camera

  private bounds(): Box3 {
    const box = this.ghostBox.clone();
    const header = this.piece?.header;
    if (header !== undefined) {
      box.expandByPoint(new Vector3(...header.low));
      box.expandByPoint(new Vector3(...header.high));
    }
    return box;
  }

  /** Put light and ground around what is there. */
  private settle(): void {
    const box = this.bounds();
    if (box.isEmpty()) return;
    const middle = box.getCenter(new Vector3());
    const radius = Math.max(0.5 * box.getSize(new Vector3()).length(), 1e-3);
    this.things.update(this.ask, middle, radius);
    const isOnFloor = this.ask.floor != null || this.ask.sketch?.kind === "shadow";
    this.ground.position.set(middle.x, (isOnFloor ? (this.ask.floor ?? 0) : box.min.y) - 0.002 * radius, middle.z);
    this.ground.scale.setScalar(40 * radius);
    const light = new Vector3(...(this.ask.light ?? [-0.55, -1, -0.5])).normalize();
    this.sun.position.copy(middle).addScaledVector(light, -4 * radius);
    this.sun.target.position.copy(middle);
    const side = 1.9 * radius;
    Object.assign(this.sun.shadow.camera, { left: -side, right: side, top: side, bottom: -side });
    // A little more than a pixel of the shadow map.
    this.sun.shadow.normalBias = 0.006 * radius;
    this.sun.shadow.camera.near = radius;
    this.sun.shadow.camera.far = 8 * radius;
    this.sun.shadow.camera.updateProjectionMatrix();
  }

  /** Look at what has come, where nothing of this model was looked at before. */
  private come(): void {
    this.settle();
    const isFirst = this.piece !== null && !this.isSettled;
    this.isSettled ||= isFirst;
    if (!this.isFramed || (isFirst && this.ask.sketch == null && !this.seesAll)) this.fit();
    this.draw();
  }

  /** Whether the camera sees all that is there. */
  get seesAll(): boolean {
    return isSeen(this.camera, this.bounds());
  }

  /** Look at everything, along the direction of our pictures. */
  fit(): void {
    const box = this.bounds();
    if (box.isEmpty()) return;
    this.orbit.target.copy(frame(this.camera, box.min, box.max, this.piece?.header.is_flat ?? false));
    this.orbit.update();
    this.isFramed = true;
    this.draw();
  }

  /** A solid of unit size above what is there, where the camera sees it. */
  above(source: string): TargetAsk {
    const box = this.bounds();
    if (box.isEmpty()) return { source };
    const side = Math.max(round(box.getSize(new Vector3()).length() / 8), 1e-3);
    const middle = box.getCenter(new Vector3());
    return { source, move: [round(middle.x), round(box.max.y + 0.3 * side), round(middle.z)], scale: [side, side, side] };
  }

  /** The lowest height of what is there. */
  bottom(): number {
    const box = this.bounds();
    return box.isEmpty() ? 0 : Math.floor(box.min.y * 100) / 100;
  }

  /** A light from behind the scene, so that its shadow falls towards the camera. */
  lightFromBehind(): [number, number, number] {
    const ahead = this.camera.getWorldDirection(new Vector3()).setY(0).normalize();
    return [round(-0.6 * ahead.x - 0.25 * ahead.z), -1, round(-0.6 * ahead.z + 0.25 * ahead.x)];
  }

  /** The next content is looked at. */
  forget(): void {
    this.isFramed = this.isSettled = false;
  }

  /** The camera as a sketch keeps it. */
  eye(): Eye {
    const { position, up, fov } = this.camera;
    return { position: position.toArray(), look_at: this.orbit.target.toArray(), up: up.toArray(), fov };
  }

  lookFrom(eye: Eye): void {
    this.camera.position.set(...eye.position);
    this.orbit.target.set(...eye.look_at);
    this.camera.fov = eye.fov;
    this.camera.updateProjectionMatrix();
    this.orbit.update();
    this.draw();
  }

  setOrbiting(isOrbiting: boolean): void {
    this.orbit.enabled = isOrbiting;
  }

  // ---- handles

  /** Put handles on an object of the scene, or take them away. */
  setHandles(name: string | null, mode: Mode): void {
    this.things.select(name, mode);
    this.draw();
  }

  /** Where the handles are seen, in CSS pixels. */
  handlePoint(): [number, number] | null {
    const at = this.things.at?.clone().project(this.camera);
    return at == null ? null : this.pixel(at);
  }

  /** Whether nothing of the page lies over a point. */
  private isFree(x: number, y: number): boolean {
    const { left, top } = this.canvas.getBoundingClientRect();
    return document.elementFromPoint(left + x, top + y) === this.canvas;
  }

  private pixel(at: Vector3): [number, number] {
    return [((at.x + 1) / 2) * this.canvas.clientWidth, ((1 - at.y) / 2) * this.canvas.clientHeight];
  }

  // ---- picking

  /** The address of the part under a point of the canvas, in CSS pixels. */
  partAt(x: number, y: number): string | null {
    return this.hitAt(x, y)?.address ?? null;
  }

  /** The part under a point of the canvas, and the point of the part that is seen there. */
  hitAt(x: number, y: number): { address: string; point: Vector3 } | null {
    const mesh = this.shape.children[0];
    if (this.piece === null || mesh === undefined) return null;
    const hit = this.ray(x, y).intersectObject(mesh, false)[0];
    if (hit?.faceIndex == null) return null;
    const address = this.piece.header.parts[this.piece.owners[hit.faceIndex]];
    return address === undefined ? null : { address, point: hit.point };
  }

  /** The direction in which the camera looks at a point. */
  sight(point: Vector3): Vector3 {
    return point.clone().sub(this.camera.position).normalize();
  }

  /** The point of the canvas in the plane through `point` that faces the camera. */
  across(x: number, y: number, point: Vector3): Vector3 {
    const facing = this.camera.getWorldDirection(new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(facing, point);
    return this.ray(x, y).ray.intersectPlane(plane, new Vector3()) ?? point.clone();
  }

  /** A line from where a dragged part is to where it should be; none without points. */
  tether(from: Vector3 | null, to: Vector3 | null): void {
    clear(this.line);
    if (from !== null && to !== null) {
      const geometry = new BufferGeometry().setFromPoints([from, to]);
      const look = { color: this.look.selected, dashSize: 0.03, gapSize: 0.02, depthTest: false, transparent: true };
      const scale = 1 / Math.max(from.distanceTo(to), 1e-9);
      const line = new LineSegments(geometry, new LineDashedMaterial({ ...look, scale }));
      line.computeLineDistances();
      line.renderOrder = 2;
      this.line.add(line);
    }
    this.draw();
  }

  /** The obstacle, light or camera under a point of the canvas. */
  thingAt(x: number, y: number): string | null {
    return this.things.hit(this.ray(x, y));
  }

  private ray(x: number, y: number): Raycaster {
    const { clientWidth, clientHeight } = this.canvas;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    return ray;
  }

  /** Where a part is seen, in CSS pixels: a point that `partAt` answers with it. */
  pointOf(address: string): [number, number] | null {
    const piece = this.piece;
    if (piece === null) return null;
    const number = piece.header.parts.indexOf(address);
    const corners = piece.geometry.index!.array;
    const at = piece.geometry.getAttribute("position") as BufferAttribute;
    const point = new Vector3();
    for (let k = 0; k < piece.owners.length; k++) {
      if (piece.owners[k] !== number) continue;
      point.set(0, 0, 0);
      for (let c = 0; c < 3; c++) point.add(new Vector3().fromBufferAttribute(at, corners[3 * k + c]));
      point.divideScalar(3).project(this.camera);
      const [x, y] = this.pixel(point);
      if (this.isFree(x, y) && this.partAt(x, y) === address) return [x, y];
    }
    return null;
  }
}

const round = (value: number): number => Math.round(value * 1e3) / 1e3;

/** A geometry with the vertices of its own triangles only, for edges. */
function compact(geometry: BufferGeometry): BufferGeometry {
  const plain = new BufferGeometry();
  plain.setAttribute("position", geometry.getAttribute("position"));
  plain.setIndex(geometry.index);
  return plain.toNonIndexed();
}

function clear(group: Group): void {
  for (const one of [...group.children] as Mesh[]) {
    group.remove(one);
    one.geometry.dispose();
    (one.material as Material).dispose();
  }
}
