// The payload of a frame as geometry; python/niwaki/studio/worker/shapes.py describes its layout.

import { BufferAttribute, BufferGeometry, Color } from "three";
import type { Shape } from "../messages";

export interface Piece {
  header: Shape;
  geometry: BufferGeometry;
  /** The number of the part of each triangle. */
  owners: Uint32Array;
}

const LINEAR = Float32Array.from({ length: 256 }, (_, byte) => new Color().setRGB(byte / 255, 0, 0, "srgb").r);

export function unpack(header: Shape, payload: ArrayBuffer): Piece {
  const n = header.vertices;
  const m = header.triangles;
  let at = 0;
  const floats = () => {
    const numbers = new Float32Array(payload, at, 3 * n);
    at += 12 * n;
    return numbers;
  };
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(floats(), 3));
  if (header.detail === "fine") geometry.setAttribute("normal", new BufferAttribute(floats(), 3));
  const bytes = new Uint8Array(payload, at, 4 * n);
  at += 4 * n;
  const colors = new Float32Array(3 * n);
  for (let k = 0; k < n; k++) {
    for (let c = 0; c < 3; c++) colors[3 * k + c] = LINEAR[bytes[4 * k + c]];
  }
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(payload, at, 3 * m), 1));
  at += 12 * m;
  const owners = new Uint32Array(payload, at, m);
  at += 4 * m;
  // Metalness and roughness.
  geometry.setAttribute("finish", new BufferAttribute(new Uint8Array(payload, at, 2 * n), 2, true));
  return { header, geometry, owners };
}

/** Makes a triangle of no size, with all attributes that a material may need. */
export function triangle(): BufferGeometry {
  const geometry = new BufferGeometry();
  const sizes = { position: 3, normal: 3, color: 3, finish: 2, uv: 2 };
  for (const [name, size] of Object.entries(sizes)) {
    geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * size), size));
  }
  return geometry;
}

/** Selects the triangles of some parts; they share the vertices of the whole. */
export function subset(piece: Piece, isIn: (address: string) => boolean): BufferGeometry | null {
  const chosen = new Set(piece.header.parts.flatMap((address, number) => (isIn(address) ? [number] : [])));
  if (chosen.size === 0) return null;
  const corners = piece.geometry.index!.array;
  const triangles: number[] = [];
  piece.owners.forEach((owner, k) => {
    if (chosen.has(owner)) triangles.push(corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]);
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", piece.geometry.getAttribute("position"));
  const normal = piece.geometry.getAttribute("normal");
  if (normal !== undefined) geometry.setAttribute("normal", normal);
  geometry.setIndex(triangles);
  return geometry;
}

/** Whether an address is at or below a call; all addresses are below "". */
export const isBelow = (address: string, call: string): boolean =>
  call === "" || address === call || address.startsWith(`${call}/`);
