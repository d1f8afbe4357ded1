// The scene in three.js: the shape, the ghost of the target, marks of selected and held parts, the camera.
//
// The stage draws only after a change. The camera moves when the user moves it, and when a window shows its first content
// or another model. It moves once more if the first shape of a model does not fit into the view, unless the user has moved
// the camera or has drawn a sketch. It never moves because of a later search, a reload or an undo.

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
import { OBSTACLE, type Arrow, type Ask, type AskChange, type Difference, type Eye, type Shape, type TargetAsk } from "../messages";
import { cubes, KINDS, sheet, tiles } from "./cells";
import { arrowMeshes } from "./arrows";
import { solid } from "./finish";
import { frame, isSeen } from "./framing";
import { type Order, sortByPart } from "./growth";
import { subset, triangle, unpack } from "./meshes";
import { kindOf, type Mode, SceneObjects } from "./objects";
import type { Piece } from "./meshes";

export const COLORS = {
  light: { paper: 0xf3f1ec, ghost: 0x5a82b8, obstacle: OBSTACLE.light, mark: 0x8a857a, selected: 0xd0652b, held: 0x2f6f8f, shade: 0.16, falling: 0xb3261e, force: 0x1f5f8b },
  dark: { paper: 0x1d1e21, ghost: 0x7fa3d4, obstacle: OBSTACLE.dark, mark: 0x8c8d92, selected: 0xf08a4b, held: 0x6fb2d2, shade: 0.45, falling: 0xff6b5e, force: 0x8cc8f0 },
};

export class Stage {
  readonly camera = new PerspectiveCamera(32, 1, 0.05, 5000);
  readonly scene = new Scene();
  piece: Piece | null = null;
  private readonly renderer: WebGLRenderer;
  private readonly orbit: OrbitControls;
  readonly objects: SceneObjects;
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
  /** Materials that keep their shaders compiled. */
  readonly materials: Material[];
  private isAsked = false;
  private isFramed = false;
  /** Whether the first shape of the model has arrived, or the user has moved the camera. */
  private isSettled = false;
  /** Pixels at the top and the bottom of the canvas over which bars of the page lie. */
  covered = { top: 0, bottom: 0 };
  /** The number of frames drawn so far. */
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
    this.objects = new SceneObjects(this.camera, canvas, onPlaced, dragging, () => this.draw());
    this.scene.add(this.objects.group, this.objects.handles.getHelper());
    this.paint("light");
    this.materials = this.warm();
  }

  /**
   * Compiles shaders before the first frame. The materials stay in memory: three.js drops shaders without a material,
   * and to compile them again takes longer than a frame.
   */
  private warm(): Material[] {
    const glass = { transparent: true, opacity: 0.5 };
    const [fill, line] = [new MeshBasicMaterial(glass), new LineBasicMaterial(glass)];
    const meshes = [solid(true), solid(false), tiles(), fill].map((material) => new Mesh(triangle(), material));
    for (const mesh of meshes) mesh.castShadow = mesh.receiveShadow = mesh.material !== fill;
    const all = [...meshes, new LineSegments(triangle(), line)];
    this.shape.add(...all);
    this.renderer.render(this.scene, this.camera);
    this.shape.clear();
    for (const { geometry } of all) geometry.dispose();
    return all.map(({ material }) => material);
  }

  /** The seconds that a frame takes, the mean of several. */
  frameSeconds(count: number): number {
    const [gl, pixel] = [this.renderer.getContext(), new Uint8Array(4)];
    const start = performance.now();
    for (let k = 0; k < count; k++) {
      this.renderer.render(this.scene, this.camera);
      // A pixel can be read only when the frame is drawn.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    }
    return (performance.now() - start) / 1000 / count;
  }

  /** Whether the canvas shows the present contents. */
  get isDrawn(): boolean {
    return !this.isAsked;
  }

  /** Draws with the next frame. */
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

  /** Shows several shapes side by side, seen by the same camera; without shapes, the single shape appears again. */
  setSides(shapes: [Shape, ArrayBuffer][]): void {
    for (const side of this.sides) clear(side);
    this.scene.remove(...this.sides);
    this.sides = shapes.map(([header, payload]) => {
      const group = new Group();
      if (header.triangles > 0) group.add(this.meshOf(unpack(header, payload)));
      return group;
    });
    if (this.sides.length > 0) this.scene.add(...this.sides);
    this.shape.visible = this.marks.visible = this.sides.length === 0;
    this.aspect();
    this.draw();
  }

  /** The number of triangles of each shape side by side. */
  get compared(): number[] {
    return this.sides.map((side) => ((side.children[0] as Mesh)?.geometry.index?.count ?? 0) / 3);
  }

  private drawSides(): void {
    const { clientWidth, clientHeight } = this.canvas;
    const edge = (k: number) => Math.round((k * clientWidth) / this.sides.length);
    this.renderer.setScissorTest(true);
    this.sides.forEach((_, k) => {
      this.sides.forEach((side, other) => (side.visible = other === k));
      this.renderer.setViewport(edge(k), 0, edge(k + 1) - edge(k), clientHeight);
      this.renderer.setScissor(edge(k), 0, edge(k + 1) - edge(k), clientHeight);
      this.renderer.render(this.scene, this.camera);
    });
    this.renderer.setScissorTest(false);
    this.renderer.setViewport(0, 0, clientWidth, clientHeight);
  }

  /** Makes the camera's view as wide as one of the shapes side by side. */
  private aspect(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.camera.aspect = clientWidth / Math.max(this.sides.length, 1) / Math.max(clientHeight, 1);
    // The narrower view shows the same width of the scene.
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
    this.objects.paint(this.look);
    this.draw();
  }

  // ---- content

  /** Shows a shape; null removes it. */
  show(header: Shape | null, payload: ArrayBuffer): void {
    clear(this.shape);
    this.piece = null;
    this.ends = null;
    if (header !== null && header.triangles > 0) {
      this.piece = unpack(header, payload);
      this.shape.add(this.meshOf(this.piece));
    }
    this.onContent();
  }

  private meshOf({ header, geometry }: Piece): Mesh {
    const material = header.is_flat
      ? new MeshBasicMaterial({ vertexColors: true })
      : solid(header.detail !== "fine");
    const mesh = new Mesh(geometry, material);
    mesh.castShadow = mesh.receiveShadow = !header.is_flat;
    return mesh;
  }

  /** Shows the first parts of the shape in an order; all parts if `count` is null. */
  setGrowth(count: number | null, order: Order, emitted: string[]): void {
    if (this.piece === null) return;
    if (count === null) this.piece.geometry.setDrawRange(0, Infinity);
    else {
      if (this.ends === null || this.ends.order !== order) this.ends = { order, at: sortByPart(this.piece, order, emitted) };
      this.piece.geometry.setDrawRange(0, 3 * this.ends.at[Math.min(count, this.ends.at.length - 1)]);
    }
    this.marks.visible = this.shape.visible && count === null;
    this.draw();
  }

  /** Shows the target or an obstacle at its place. */
  setSolid(name: string, header: Shape, payload: ArrayBuffer, placement: TargetAsk | null): void {
    const isOther = kindOf(name) === "target" && this.objects.source(name) !== placement?.source;
    this.objects.setSolid(name, header, payload, placement);
    if (kindOf(name) === "target") {
      this.ghostBox.makeEmpty();
      if (header.triangles > 0) this.ghostBox.set(new Vector3(...header.low), new Vector3(...header.high));
    }
    this.onContent(isOther);
  }

  /** Sets the goals other than solids: floor, light and camera. */
  setAsk(ask: Ask): void {
    this.ask = ask;
    this.settle();
    this.draw();
  }

  setGhostVisible(isVisible: boolean): void {
    this.objects.setGhostVisible(isVisible);
    this.draw();
  }

  /** Shows the difference from the target in place of the scene; null shows the scene. */
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

  /** Marks parts: selected parts and parts under the pointer, held parts, falling parts. */
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

  /** Shows forces; the longest arrow has a fifth of the scene's size. */
  setArrows(forces: Arrow[]): void {
    clear(this.arrows);
    const size = this.bounds().getSize(new Vector3()).length();
    for (const arrow of arrowMeshes(forces, 0.2 * size, this.look.force)) this.arrows.add(arrow);
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

  /** Moves light and ground to the contents. */
  private settle(): void {
    const box = this.bounds();
    if (box.isEmpty()) return;
    const middle = box.getCenter(new Vector3());
    const radius = Math.max(0.5 * box.getSize(new Vector3()).length(), 1e-3);
    this.objects.update(this.ask, middle, radius);
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

  /** Moves light and ground; moves the camera if it has shown no result of this model, and other contents do not fit. */
  private onContent(isOther = true): void {
    this.settle();
    const wasSettled = this.isSettled;
    this.isSettled ||= this.piece !== null && this.piece.header.role !== "prior";
    const isOpen = !wasSettled && isOther && this.ask.sketch == null;
    if (!this.isFramed || (isOpen && !this.seesAll)) this.fit();
    this.draw();
  }

  /** Whether the camera sees all contents. */
  get seesAll(): boolean {
    return isSeen(this.camera, this.bounds());
  }

  /** Fits all contents into the view, along the direction of pictures. */
  fit(): void {
    const box = this.bounds();
    if (box.isEmpty()) return;
    const high = Math.max(this.canvas.clientHeight, 1);
    const free = { top: Math.min(this.covered.top / high, 0.2), bottom: Math.min(this.covered.bottom / high, 0.2) };
    this.orbit.target.copy(frame(this.camera, box.min, box.max, this.piece?.header.is_flat ?? false, 0.06, free));
    this.orbit.update();
    this.isFramed = true;
    this.draw();
  }

  /** Moves the camera to the next contents. */
  followNext(): void {
    this.isFramed = false;
  }

  /** The box of the contents on the canvas, CSS pixels: left, top, right, bottom. */
  box(): [number, number, number, number] {
    const { min, max } = this.bounds();
    this.camera.updateMatrixWorld();
    const points = [0, 1, 2, 3, 4, 5, 6, 7].map((k) =>
      this.pixel(new Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z).project(this.camera)),
    );
    const [x, y] = [points.map(([x]) => x), points.map(([, y]) => y)];
    return [Math.min(...x), Math.min(...y), Math.max(...x), Math.max(...y)];
  }

  /** The box beside which new objects are placed: of the target, or of the model without a target. */
  private home(): Box3 {
    const isPrior = this.piece?.header.role === "prior";
    return isPrior && !this.ghostBox.isEmpty() ? this.ghostBox.clone() : this.bounds();
  }

  /** Returns a solid above the contents, where the camera sees it. */
  above(source: string): TargetAsk {
    const box = this.home();
    if (box.isEmpty()) return { source };
    const side = Math.max(round(box.getSize(new Vector3()).length() / 8), 1e-3);
    const middle = box.getCenter(new Vector3());
    return { source, move: [round(middle.x), round(box.max.y + 0.3 * side), round(middle.z)], scale: [side, side, side] };
  }

  /** The lowest height of the target; of the contents without a target. */
  bottom(): number {
    const box = this.ghostBox.isEmpty() ? this.bounds() : this.ghostBox;
    return box.isEmpty() ? 0 : Math.floor(box.min.y * 100) / 100;
  }

  /** Returns a light from behind the scene, so that the shadow falls towards the camera. */
  lightFromBehind(): [number, number, number] {
    const ahead = this.camera.getWorldDirection(new Vector3()).setY(0).normalize();
    return [round(-0.6 * ahead.x - 0.25 * ahead.z), -1, round(-0.6 * ahead.z + 0.25 * ahead.x)];
  }

  /** Lets the camera move to the contents of another model; the former target counts no more, though it is drawn until the next one arrives. */
  forget(): void {
    this.isFramed = this.isSettled = false;
    this.ghostBox.makeEmpty();
  }

  /** Returns the camera in the form of a sketch. */
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

  /** Attaches handles to an object of the scene; null removes them. */
  setHandles(name: string | null, mode: Mode): void {
    this.objects.select(name, mode);
    this.draw();
  }

  /** The point of the handles on the canvas, CSS pixels. */
  handlePoint(): [number, number] | null {
    const at = this.objects.at?.clone().project(this.camera);
    return at == null ? null : this.pixel(at);
  }

  /** Whether no element of the page lies over a point. */
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

  /** The part under a point of the canvas, and the visible point of the part. */
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

  /** Draws a line from a dragged part to the pointer; null removes it. */
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
  objectAt(x: number, y: number): string | null {
    return this.objects.hit(this.ray(x, y));
  }

  private ray(x: number, y: number): Raycaster {
    const { clientWidth, clientHeight } = this.canvas;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    return ray;
  }

  /** A point of the canvas at which `partAt` returns a part, CSS pixels. */
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

/** Copies a geometry with only the vertices of its triangles, for edges. */
function compact(geometry: BufferGeometry): BufferGeometry {
  const plain = new BufferGeometry();
  plain.setAttribute("position", geometry.getAttribute("position"));
  plain.setIndex(geometry.index);
  return plain.toNonIndexed();
}

function clear(group: Group): void {
  for (const mesh of [...group.children] as Mesh[]) {
    group.remove(mesh);
    mesh.geometry.dispose();
    (mesh.material as Material).dispose();
  }
}
