// Small pictures of results, all from one direction; a single renderer draws them in turn.

import {
  BufferGeometry,
  Color,
  DirectionalLight,
  HemisphereLight,
  Material,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Shape } from "../messages";
import { frame } from "./framing";
import { COLORS } from "./stage";
import { triangle, unpack } from "./meshes";

const SHARP = Math.min(Math.max(devicePixelRatio, 1), 2);
export const WIDTH = Math.round(148 * SHARP);
export const HEIGHT = Math.round(98 * SHARP);

const waiting: (() => void)[] = [];

/** Draws pictures in turn, so that the page answers clicks between them. */
export function later(draw: () => void): void {
  waiting.push(draw);
  if (waiting.length === 1) setTimeout(next, 30);
}

function next(): void {
  waiting[0]();
  waiting.shift();
  if (waiting.length > 0) setTimeout(next, 8);
}

let renderer: WebGLRenderer | null = null;
// The materials stay in memory: three.js drops shaders without a material, and would compile them again.
const materials = {
  flat: new MeshBasicMaterial({ vertexColors: true }),
  fine: new MeshLambertMaterial({ vertexColors: true }),
  coarse: new MeshLambertMaterial({ vertexColors: true, flatShading: true }),
};

/** Compiles the shaders of small pictures before the first picture. */
export function warm(): void {
  const pen = document.createElement("canvas").getContext("2d")!;
  // `drawImage` waits until the picture is drawn.
  for (const material of Object.values(materials)) pen.drawImage(render(triangle(), material, "light", [0, 0, 0], [1, 1, 1]), 0, 0);
}

/** Draws a shape into a canvas; `low` and `high` are the corners of the box that it shows. */
export function thumbnail(
  canvas: HTMLCanvasElement,
  header: Shape,
  payload: ArrayBuffer,
  theme: "light" | "dark",
  low: number[],
  high: number[],
): void {
  const pen = canvas.getContext("2d")!;
  if (header.triangles === 0) {
    pen.clearRect(0, 0, WIDTH, HEIGHT);
    return;
  }
  const { geometry } = unpack(header, payload);
  const material = materials[header.is_flat ? "flat" : header.detail === "fine" ? "fine" : "coarse"];
  pen.drawImage(render(geometry, material, theme, low, high), 0, 0, WIDTH, HEIGHT);
}

/** Draws a geometry and disposes of it. */
function render(
  geometry: BufferGeometry,
  material: Material,
  theme: "light" | "dark",
  low: number[],
  high: number[],
): HTMLCanvasElement {
  renderer ??= new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(WIDTH, HEIGHT, false);
  const scene = new Scene();
  scene.background = new Color(COLORS[theme].paper);
  const sun = new DirectionalLight(0xfff9ef, 2.3);
  sun.position.set(0.55, 1, 0.5);
  scene.add(new Mesh(geometry, material), new HemisphereLight(0xffffff, 0xdedad2, 1.85), sun);
  const from = new Vector3(...(low as [number, number, number]));
  const to = new Vector3(...(high as [number, number, number]));
  const camera = new PerspectiveCamera(28, WIDTH / HEIGHT, 0.1, 1000);
  frame(camera, from, to, material === materials.flat, 0.02);
  renderer.render(scene, camera);
  geometry.dispose();
  return renderer.domElement;
}
