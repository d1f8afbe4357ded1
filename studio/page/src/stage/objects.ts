// Goals as objects of the scene: the target and the obstacles as ghosts, the floor, the light of a shadow, the camera of a
// sketch; and the handles of the selected object.

import {
  BufferAttribute,
  BufferGeometry,
  Camera,
  EdgesGeometry,
  GridHelper,
  Group,
  LineBasicMaterial,
  LineSegments,
  Material,
  Mesh,
  MeshBasicMaterial,
  Object3D,
  Raycaster,
  SphereGeometry,
  Vector3,
} from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import type { Ask, AskChange, Eye, Shape, TargetAsk } from "../messages";
import { unpack } from "./meshes";

export type Mode = "translate" | "scale" | "rotate";

/** The modes of the handles of each kind of object. */
export const MODES: Record<string, Mode[]> = {
  target: ["translate", "scale", "rotate"],
  obstacle: ["translate", "scale", "rotate"],
  floor: ["translate"],
  light: ["translate"],
  camera: ["translate"],
};

export const kindOf = (name: string): string => name.split(" ")[0];
export const numberOf = (name: string): number => Number(name.split(" ")[1] ?? 0);

interface Solid {
  placement: TargetAsk;
  pivot: Vector3;
}

interface Look {
  ghost: number;
  obstacle: number;
  mark: number;
}

export class SceneObjects {
  readonly group = new Group();
  readonly handles: TransformControls;
  private readonly solids = new Map<string, Solid>();
  private readonly objects = new Map<string, Object3D>();
  private selected: string | null = null;
  private mode: Mode = "translate";
  private ask: Ask = {};
  private middle = new Vector3();
  private radius = 1;
  private isGhostVisible = true;
  look: Look = { ghost: 0, obstacle: 0, mark: 0 };

  constructor(
    camera: Camera,
    canvas: HTMLCanvasElement,
    private readonly onPlaced: (change: AskChange) => void,
    onDragging: (isDragging: boolean) => void,
    private readonly draw: () => void,
  ) {
    this.handles = new TransformControls(camera, canvas);
    this.handles.setSpace("local");
    this.handles.size = 0.75;
    this.handles.setColors(0xc2571f, 0x5f8f4e, 0x3f76a8, 0xf2b33d);
    this.handles.addEventListener("dragging-changed", ({ value }) => {
      onDragging(value as boolean);
      if (!value) this.place();
    });
    this.handles.addEventListener("change", draw);
  }

  /** Shows a solid at its place; a shape without triangles removes it. */
  setSolid(name: string, header: Shape, payload: ArrayBuffer, placement: TargetAsk | null): void {
    this.remove(name);
    if (header.triangles === 0 || placement === null) return;
    const { geometry } = unpack(header, payload);
    const turn = ((placement.turn ?? 0) * Math.PI) / 180;
    const pivot = new Vector3(...header.pivot);
    geometry.translate(-pivot.x, -pivot.y, -pivot.z).rotateY(-turn);
    const isTarget = kindOf(name) === "target";
    const color = isTarget ? this.look.ghost : this.look.obstacle;
    const fill = new MeshBasicMaterial({ color, transparent: true, opacity: isTarget ? 0.1 : 0.32, depthWrite: false });
    const line = new LineBasicMaterial({ color, transparent: true, opacity: 0.7 });
    const group = new Group();
    group.add(new Mesh(geometry, fill), new LineSegments(new EdgesGeometry(geometry, 24), line));
    group.position.copy(pivot);
    group.rotation.set(0, turn, 0);
    group.visible = !isTarget || this.isGhostVisible;
    this.solids.set(name, { placement, pivot });
    this.put(name, group);
  }

  get names(): string[] {
    return [...this.objects.keys()];
  }

  /** The source of a solid on the stage. */
  source(name: string): string | null {
    return this.solids.get(name)?.placement.source ?? null;
  }

  triangles(name: string): number {
    return ((this.objects.get(name)?.children[0] as Mesh | undefined)?.geometry.index?.count ?? 0) / 3;
  }

  /** The position of the selected object. */
  get at(): Vector3 | null {
    return (this.selected !== null && this.objects.get(this.selected)?.position) || null;
  }

  /** Updates the objects to the goals, around the scene. */
  update(ask: Ask, middle: Vector3, radius: number): void {
    this.ask = ask;
    this.middle.copy(middle);
    this.radius = radius;
    for (const name of [...this.solids.keys()]) {
      if (kindOf(name) === "obstacle" && numberOf(name) >= (ask.obstacles ?? []).length) this.remove(name);
    }
    for (const name of ["floor", "light", "camera"]) this.remove(name);
    if (ask.floor != null) this.put("floor", this.floor(ask.floor));
    if (ask.sketch?.kind === "shadow") this.put("light", this.light(ask.light ?? [-0.55, -1, -0.5]));
    if (ask.sketch?.camera != null) this.put("camera", eyeOf(ask.sketch.camera, ask.sketch.aspect, this.look.mark));
    this.draw();
  }

  private floor(y: number): Object3D {
    const grid = new GridHelper(6 * this.radius, 24, this.look.mark, this.look.mark);
    Object.assign(grid.material, { transparent: true, opacity: 0.28, depthWrite: false });
    grid.position.set(this.middle.x, y, this.middle.z);
    return grid;
  }

  private light(direction: [number, number, number]): Object3D {
    const sun = new Group();
    const away = new Vector3(...direction).normalize().multiplyScalar(-1.25 * this.radius);
    sun.add(new Mesh(new SphereGeometry(0.05 * this.radius, 24, 16), new MeshBasicMaterial({ color: 0xf2b33d })));
    sun.add(segments([0, 0, 0, ...away.clone().multiplyScalar(-0.5).toArray()], 0xf2b33d));
    sun.position.copy(this.middle).add(away);
    return sun;
  }

  paint(look: Look): void {
    this.look = look;
    for (const [name, object] of this.objects) {
      const color = kindOf(name) === "obstacle" ? look.obstacle : kindOf(name) === "target" ? look.ghost : look.mark;
      if (kindOf(name) !== "light") object.traverse((part) => materialOf(part)?.color?.set(color));
    }
  }

  setGhostVisible(isVisible: boolean): void {
    this.isGhostVisible = isVisible;
    const ghost = this.objects.get("target");
    if (ghost !== undefined) ghost.visible = isVisible;
  }

  /** Attaches handles to an object; null removes them. */
  select(name: string | null, mode: Mode = "translate"): void {
    this.selected = name;
    this.mode = mode;
    const object = name === null ? undefined : this.objects.get(name);
    if (name === null || object === undefined || !MODES[kindOf(name)].includes(mode)) {
      this.handles.detach();
      return;
    }
    this.handles.attach(object);
    this.handles.setMode(mode);
    const isUpright = mode === "rotate" || kindOf(name) === "floor";
    this.handles.showX = this.handles.showZ = !isUpright;
    this.handles.showY = true;
  }

  /** The obstacle, light or camera that a ray meets first. */
  hit(ray: Raycaster): string | null {
    let first: string | null = null;
    let nearest = Infinity;
    for (const [name, object] of this.objects) {
      const distance = kindOf(name) === "target" ? undefined : ray.intersectObject(object.children[0] ?? object, false)[0]?.distance;
      if (distance !== undefined && distance < nearest && kindOf(name) !== "floor") [first, nearest] = [name, distance];
    }
    return first;
  }

  private put(name: string, object: Object3D): void {
    this.objects.set(name, object);
    this.group.add(object);
    if (name === this.selected) this.select(name, this.mode);
  }

  private remove(name: string): void {
    const object = this.objects.get(name);
    if (object === undefined) return;
    if (name === this.selected) this.handles.detach();
    this.group.remove(object);
    object.traverse((part) => {
      (part as Mesh).geometry?.dispose();
      materialOf(part)?.dispose();
    });
    this.objects.delete(name);
    this.solids.delete(name);
  }

  /** Sends the new goals when the handles are released. */
  private place(): void {
    const name = this.selected;
    const object = name === null ? undefined : this.objects.get(name);
    if (name === null || object === undefined) return;
    const at = object.position;
    const sketch = this.ask.sketch;
    if (name === "floor") this.onPlaced({ floor: round(at.y) });
    else if (name === "light") {
      const way = this.middle.clone().sub(at).normalize();
      this.onPlaced({ light: [round(way.x), round(Math.min(way.y, -0.02)), round(way.z)] });
    } else if (name === "camera" && sketch?.camera != null) {
      const position = at.toArray().map(round) as [number, number, number];
      this.onPlaced({ sketch: { ...sketch, camera: { ...sketch.camera, position } } });
    } else {
      const solid = this.solids.get(name);
      if (solid === undefined) return;
      const placement = this.placementOf(solid, object);
      if (name === "target") this.onPlaced({ target: placement });
      else {
        const obstacles = (this.ask.obstacles ?? []).map((obstacle, k) => (k === numberOf(name) ? placement : obstacle));
        this.onPlaced({ obstacles });
      }
    }
  }

  private placementOf({ placement, pivot }: Solid, { position, rotation, scale }: Object3D): TargetAsk {
    const before = placement.scale ?? [1, 1, 1];
    const moved = placement.move ?? [0, 0, 0];
    const larger = (k: 0 | 1 | 2, by: number) => round(Math.max(before[k] * by, 1e-3));
    return {
      source: placement.source,
      move: [
        round(moved[0] + position.x - pivot.x),
        round(moved[1] + position.y - pivot.y),
        round(moved[2] + position.z - pivot.z),
      ],
      scale: [larger(0, scale.x), larger(1, scale.y), larger(2, scale.z)],
      turn: round((rotation.y * 180) / Math.PI),
    };
  }
}

/** Draws a camera as a pyramid of lines at its place in the scene. */
function eyeOf(eye: Eye, aspect: number, color: number): Object3D {
  const from = new Vector3(...eye.position);
  const ahead = new Vector3(...eye.look_at).sub(from);
  const depth = 0.12 * ahead.length();
  ahead.normalize();
  const right = new Vector3().crossVectors(ahead, new Vector3(...eye.up)).normalize();
  const up = new Vector3().crossVectors(right, ahead);
  const high = depth * Math.tan((eye.fov * Math.PI) / 360);
  const corners = [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].map(([x, y]) =>
    ahead
      .clone()
      .multiplyScalar(depth)
      .addScaledVector(right, x * high * aspect)
      .addScaledVector(up, y * high)
      .toArray(),
  );
  const lines = corners.flatMap((corner, k) => [0, 0, 0, ...corner, ...corner, ...corners[(k + 1) % 4]]);
  const holder = new Group();
  holder.add(segments(lines, color));
  holder.position.copy(from);
  return holder;
}

function segments(points: number[], color: number): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color, transparent: true, opacity: 0.8 }));
}

const materialOf = (part: Object3D) => (part as Mesh).material as (Material & { color?: { set(c: number): void } }) | undefined;
const round = (value: number): number => Math.round(value * 1e4) / 1e4;
