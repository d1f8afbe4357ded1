// The scene in three.js: the shape, the ghost of the target, marks of selected and pinned parts, the camera.
//
// Nothing is drawn unless something has changed. The camera moves when the user moves it, and when a window shows its
// first content or another model; never because of a search, a reload or an undo.

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
  MeshStandardMaterial,
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
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Eye, Shape, TargetAsk } from "../messages";
import { frame } from "./framing";
import { subset, unpacked } from "./meshes";
import type { Piece } from "./meshes";

export const COLORS = {
  light: { paper: 0xf3f1ec, ghost: 0x5a82b8, selected: 0xd0652b, pinned: 0x2f6f8f, shade: 0.16 },
  dark: { paper: 0x1d1e21, ghost: 0x7fa3d4, selected: 0xf08a4b, pinned: 0x6fb2d2, shade: 0.45 },
};

export class Stage {
  readonly camera = new PerspectiveCamera(32, 1, 0.05, 5000);
  readonly scene = new Scene();
  piece: Piece | null = null;
  private readonly renderer: WebGLRenderer;
  private readonly orbit: OrbitControls;
  private readonly handles: TransformControls;
  private readonly sun = new DirectionalLight(0xfff9ef, 2.3);
  private readonly ground: Mesh;
  private readonly shape = new Group();
  private readonly marks = new Group();
  private readonly ghost = new Group();
  private readonly line = new Group();
  private ghostBox = new Box3();
  private look = COLORS.light;
  private isAsked = false;
  private isFramed = false;
  private asked: TargetAsk | null = null;
  /** Pixels may be drawn again. */
  frames = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly onPlaced: (ask: TargetAsk) => void,
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
      this.ghost,
      this.line,
    );
    this.camera.position.set(14, 9, 18);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.enableDamping = false;
    this.orbit.addEventListener("change", () => {
      this.draw();
      this.onLook();
    });
    this.handles = new TransformControls(this.camera, canvas);
    this.handles.setSpace("local");
    this.handles.size = 0.8;
    this.handles.addEventListener("dragging-changed", ({ value }) => {
      this.orbit.enabled = !value;
      if (!value) this.place();
    });
    this.handles.addEventListener("change", () => this.draw());
    this.scene.add(this.handles.getHelper());
    this.paint("light");
  }

  /** Draw with the next frame. */
  draw(): void {
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      this.frames++;
      this.renderer.render(this.scene, this.camera);
    });
  }

  resize(width: number, height: number): void {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  paint(theme: "light" | "dark"): void {
    this.look = COLORS[theme];
    this.scene.background = new Color(this.look.paper);
    (this.ground.material as ShadowMaterial).opacity = this.look.shade;
    this.ghost.traverse((one) => {
      const material = (one as Mesh).material as (Material & { color: Color }) | undefined;
      material?.color.set(this.look.ghost);
    });
    this.draw();
  }

  // ---- content

  /** Show a shape; an empty payload takes it away. */
  show(header: Shape | null, payload: ArrayBuffer): void {
    clear(this.shape);
    this.piece = null;
    if (header !== null && header.triangles > 0) {
      this.piece = unpacked(header, payload);
      const isFine = header.detail === "fine";
      const material = header.is_flat
        ? new MeshBasicMaterial({ vertexColors: true })
        : new MeshStandardMaterial({ vertexColors: true, roughness: 0.72, flatShading: !isFine });
      const mesh = new Mesh(this.piece.geometry, material);
      mesh.castShadow = mesh.receiveShadow = !header.is_flat;
      this.shape.add(mesh);
    }
    this.settle();
    this.draw();
  }

  /** Show the ghost of a target where it is placed. */
  setGhost(header: Shape, payload: ArrayBuffer, ask: TargetAsk | null): void {
    this.handles.detach();
    clear(this.ghost);
    this.ghostBox.makeEmpty();
    this.asked = ask;
    if (header.triangles > 0) {
      const { geometry } = unpacked(header, payload);
      const turn = ((ask?.turn ?? 0) * Math.PI) / 180;
      const pivot = new Vector3(...header.pivot);
      geometry.translate(-pivot.x, -pivot.y, -pivot.z).rotateY(-turn);
      this.ghost.position.copy(pivot);
      this.ghost.rotation.set(0, turn, 0);
      this.ghost.scale.set(1, 1, 1);
      const color = this.look.ghost;
      const fill = new MeshBasicMaterial({ color, transparent: true, opacity: 0.1, depthWrite: false });
      const line = new LineBasicMaterial({ color, transparent: true, opacity: 0.7 });
      this.ghost.add(new Mesh(geometry, fill), new LineSegments(new EdgesGeometry(geometry, 24), line));
      this.ghostBox.set(new Vector3(...header.low), new Vector3(...header.high));
    }
    this.settle();
    this.draw();
  }

  setGhostVisible(isVisible: boolean): void {
    this.ghost.visible = isVisible;
    this.draw();
  }

  /** Mark parts: those that are selected or under the pointer, and those that are pinned. */
  mark(isSelected: (address: string) => boolean, isPinned: (address: string) => boolean): void {
    clear(this.marks);
    if (this.piece !== null && !this.piece.header.is_flat) {
      this.tint(isPinned, this.look.pinned, 0.28);
      this.tint(isSelected, this.look.selected, 0.35);
    }
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

  /** Put light and ground around what is there; look at it if nothing was looked at before. */
  private settle(): void {
    const box = this.bounds();
    if (box.isEmpty()) return;
    const middle = box.getCenter(new Vector3());
    const radius = Math.max(0.5 * box.getSize(new Vector3()).length(), 1e-3);
    this.ground.position.set(middle.x, box.min.y - 0.002 * radius, middle.z);
    this.ground.scale.setScalar(40 * radius);
    this.sun.position.copy(middle).addScaledVector(new Vector3(0.55, 1.0, 0.5).normalize(), 4 * radius);
    this.sun.target.position.copy(middle);
    const side = 1.9 * radius;
    Object.assign(this.sun.shadow.camera, { left: -side, right: side, top: side, bottom: -side });
    // A little more than a pixel of the shadow map.
    this.sun.shadow.normalBias = 0.006 * radius;
    this.sun.shadow.camera.near = radius;
    this.sun.shadow.camera.far = 8 * radius;
    this.sun.shadow.camera.updateProjectionMatrix();
    if (!this.isFramed) this.fit();
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

  /** The next content is looked at. */
  forget(): void {
    this.isFramed = false;
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

  setHandles(mode: "translate" | "scale" | "rotate" | null): void {
    if (mode === null || this.ghost.children.length === 0) this.handles.detach();
    else {
      this.handles.attach(this.ghost);
      this.handles.setMode(mode);
      this.handles.showX = this.handles.showZ = mode !== "rotate";
    }
    this.draw();
  }

  /** The handles were let go: the target as it now stands. */
  private place(): void {
    const ask = this.asked;
    if (ask === null) return;
    const { position, rotation, scale } = this.ghost;
    const was = ask.scale ?? [1, 1, 1];
    const moved = ask.move ?? [0, 0, 0];
    const from = this.pivot;
    this.onPlaced({
      source: ask.source,
      move: [
        round(moved[0] + position.x - from.x),
        round(moved[1] + position.y - from.y),
        round(moved[2] + position.z - from.z),
      ],
      scale: [
        round(Math.max(was[0] * scale.x, 1e-3)),
        round(Math.max(was[1] * scale.y, 1e-3)),
        round(Math.max(was[2] * scale.z, 1e-3)),
      ],
      turn: round((rotation.y * 180) / Math.PI),
    });
  }
  pivot = new Vector3();

  // ---- picking

  /** The address of the part under a point of the canvas, in CSS pixels. */
  partAt(x: number, y: number): string | null {
    return this.hitAt(x, y)?.address ?? null;
  }

  private hitAt(x: number, y: number): { address: string; point: Vector3 } | null {
    const mesh = this.shape.children[0];
    if (this.piece === null || mesh === undefined) return null;
    const hit = this.rayTo(x, y).intersectObject(mesh, false)[0];
    if (hit?.faceIndex == null) return null;
    const address = this.piece.header.parts[this.piece.owners[hit.faceIndex]];
    return address === undefined ? null : { address, point: hit.point };
  }

  private rayTo(x: number, y: number): Raycaster {
    const { clientWidth, clientHeight } = this.canvas;
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    return ray;
  }

  /** The part under a point of the canvas, and the point of the part that is seen there. */
  holdAt(x: number, y: number): { address: string; point: Vector3 } | null {
    const hit = this.hitAt(x, y);
    return hit && { address: hit.address, point: hit.point };
  }

  /** The direction in which the camera looks at a point. */
  sight(point: Vector3): Vector3 {
    return point.clone().sub(this.camera.position).normalize();
  }

  /** The point of the canvas in the plane through `point` that faces the camera. */
  across(x: number, y: number, point: Vector3): Vector3 {
    const facing = this.camera.getWorldDirection(new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(facing, point);
    return this.rayTo(x, y).ray.intersectPlane(plane, new Vector3()) ?? point.clone();
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
      const x = ((point.x + 1) / 2) * this.canvas.clientWidth;
      const y = ((1 - point.y) / 2) * this.canvas.clientHeight;
      if (this.partAt(x, y) === address) return [x, y];
    }
    return null;
  }
}

const round = (value: number): number => Math.round(value * 1e4) / 1e4;

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
