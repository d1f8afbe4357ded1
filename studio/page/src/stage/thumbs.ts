// Small pictures of results, all from one direction, by one renderer that draws one after the other.

import {
  Color,
  DirectionalLight,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Shape } from "../messages";
import { COLORS } from "./stage";
import { unpacked } from "./meshes";

export const WIDTH = 296;
export const HEIGHT = 208;

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
    : new MeshStandardMaterial({ vertexColors: true, roughness: 0.75, flatShading: header.detail !== "fine" });
  const sun = new DirectionalLight(0xfff4e2, 2.4);
  sun.position.set(0.55, 1, 0.5);
  scene.add(new Mesh(geometry, material), new HemisphereLight(0xffffff, 0xd8d2c6, 1.7), sun);
  const from = new Vector3(...(low as [number, number, number]));
  const to = new Vector3(...(high as [number, number, number]));
  const middle = from.clone().add(to).multiplyScalar(0.5);
  const radius = Math.max(0.5 * to.clone().sub(from).length(), 1e-3);
  const camera = new PerspectiveCamera(28, WIDTH / HEIGHT, radius / 50, radius * 50);
  const away = header.is_flat ? new Vector3(0, 0, 1) : new Vector3(0.62, 0.44, 0.78);
  camera.position.copy(middle).addScaledVector(away.normalize(), (0.9 * radius) / Math.sin((14 * Math.PI) / 180));
  camera.lookAt(middle);
  renderer.render(scene, camera);
  pen.drawImage(renderer.domElement, 0, 0, WIDTH, HEIGHT);
  geometry.dispose();
  material.dispose();
}
