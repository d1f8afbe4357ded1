// Small pictures of results, all from one direction, by one renderer that draws one after the other.

import {
  Color,
  DirectionalLight,
  HemisphereLight,
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
import { unpacked } from "./meshes";

const SHARP = Math.min(Math.max(devicePixelRatio, 1), 2);
export const WIDTH = Math.round(148 * SHARP);
export const HEIGHT = Math.round(98 * SHARP);

const waiting: (() => void)[] = [];

/** Draws one picture after the other, so that none of them keeps the page from what is clicked meanwhile. */
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

/** Draws a shape into a canvas; `low` and `high` are what all pictures of the gallery look at. */
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
  renderer ??= new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(WIDTH, HEIGHT, false);
  const scene = new Scene();
  scene.background = new Color(COLORS[theme].paper);
  const { geometry } = unpacked(header, payload);
  const material = header.is_flat
    ? new MeshBasicMaterial({ vertexColors: true })
    : new MeshLambertMaterial({ vertexColors: true, flatShading: header.detail !== "fine" });
  const sun = new DirectionalLight(0xfff9ef, 2.3);
  sun.position.set(0.55, 1, 0.5);
  scene.add(new Mesh(geometry, material), new HemisphereLight(0xffffff, 0xdedad2, 1.85), sun);
  const from = new Vector3(...(low as [number, number, number]));
  const to = new Vector3(...(high as [number, number, number]));
  const camera = new PerspectiveCamera(28, WIDTH / HEIGHT, 0.1, 1000);
  frame(camera, from, to, header.is_flat, 0.02);
  renderer.render(scene, camera);
  pen.drawImage(renderer.domElement, 0, 0, WIDTH, HEIGHT);
  geometry.dispose();
  material.dispose();
}
