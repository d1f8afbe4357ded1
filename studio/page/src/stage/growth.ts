// The growth of a shape: triangles in the order of their parts, so that a range of them is the shape so far.

import { BufferAttribute } from "three";
import type { Piece } from "./meshes";

/** The order of parts: as the run emits them, or outer calls first. */
export type Order = "emitted" | "depth";

/** Sorts the triangles of a piece by their parts; returns the number of triangles of the first k parts. */
export function sortByPart(piece: Piece, order: Order, emitted: string[]): Uint32Array {
  const { parts } = piece.header;
  const depth = (address: string) => address.split("/").length;
  const turn = new Map(emitted.map((address, k) => [address, k]));
  const at = (part: number) => turn.get(parts[part]) ?? part;
  const places = parts.map((_, k) => k);
  places.sort((a, b) => (order === "depth" ? depth(parts[a]) - depth(parts[b]) : 0) || at(a) - at(b));
  const rank = new Uint32Array(parts.length);
  places.forEach((part, k) => (rank[part] = k));
  const corners = piece.geometry.index!.array;
  const triangles = Array.from(piece.owners, (_, k) => k).sort((a, b) => rank[piece.owners[a]] - rank[piece.owners[b]] || a - b);
  const index = new Uint32Array(corners.length);
  const owners = new Uint32Array(piece.owners.length);
  const ends = new Uint32Array(parts.length + 1);
  triangles.forEach((from, to) => {
    for (let c = 0; c < 3; c++) index[3 * to + c] = corners[3 * from + c];
    owners[to] = piece.owners[from];
    ends[rank[owners[to]] + 1]++;
  });
  for (let k = 1; k < ends.length; k++) ends[k] += ends[k - 1];
  piece.geometry.setIndex(new BufferAttribute(index, 1));
  piece.owners = owners;
  return ends;
}
