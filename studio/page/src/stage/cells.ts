// The difference to a target: its cells, in the colours of the legend.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DataTexture,
  Group,
  LinearFilter,
  LinearMipmapLinearFilter,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  NearestFilter,
  PlaneGeometry,
  SRGBColorSpace,
} from "three";
import type { Difference } from "../messages";

/** Of what is wanted and filled, wanted only, filled only. */
export const KINDS = {
  light: [0, 0xaaa69c, 0x3f7fc0, 0xd0652b],
  dark: [0, 0x6d6e73, 0x6aa9e6, 0xf08a4b],
};

/** The sides of a cell: the step to its neighbour, and the corners, counter-clockwise from outside. */
const SIDES = [0, 1, 2].flatMap((axis) =>
  [0, 1].map((end) => {
    const corner = (u: number, v: number) => {
      const found = [0, 0, 0];
      [found[axis], found[(axis + 1) % 3], found[(axis + 2) % 3]] = [end, u, v];
      return found;
    };
    const step = [0, 0, 0];
    step[axis] = 2 * end - 1;
    const around = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
    return { step, corners: end === 1 ? around : around.reverse() };
  }),
);
/** Where the corners of a side are in its picture. */
const EDGES = [0, 0, 1, 0, 1, 1, 0, 1];

/** The sides of cells that can be seen: those beside an empty cell. */
export function cubes({ size, low, high }: Difference, marks: Uint8Array, colors: number[]): Group {
  const [nx, ny, nz] = size;
  const at = (x: number, y: number, z: number) =>
    x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz ? 0 : marks[(z * ny + y) * nx + x];
  const seen: number[] = [];
  for (let z = 0, k = 0; z < nz; z++) {
    for (let y = 0; y < ny; y++) {
      for (let x = 0; x < nx; x++, k++) {
        if (marks[k] === 0) continue;
        SIDES.forEach(({ step }, side) => {
          if (at(x + step[0], y + step[1], z + step[2]) === 0) seen.push(x, y, z, side);
        });
      }
    }
  }
  const n = seen.length / 4;
  const [places, normals, shades, edges] = [12, 12, 12, 8].map((one) => new Float32Array(one * n));
  const corners = new Uint32Array(6 * n);
  const widths = high.map((end, axis) => (end - low[axis]) / size[axis]);
  const paint = colors.map((one) => new Color(one));
  for (let k = 0; k < n; k++) {
    const [x, y, z, side] = seen.slice(4 * k, 4 * k + 4);
    const color = paint[at(x, y, z)];
    SIDES[side].corners.forEach((corner, c) => {
      const first = 12 * k + 3 * c;
      [x, y, z].forEach((cell, axis) => (places[first + axis] = low[axis] + (cell + corner[axis]) * widths[axis]));
      normals.set(SIDES[side].step, first);
      shades.set([color.r, color.g, color.b], first);
    });
    edges.set(EDGES, 8 * k);
    corners.set([0, 1, 2, 0, 2, 3].map((one) => 4 * k + one), 6 * k);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  geometry.setAttribute("normal", new BufferAttribute(normals, 3));
  geometry.setAttribute("color", new BufferAttribute(shades, 3));
  geometry.setAttribute("uv", new BufferAttribute(edges, 2));
  geometry.setIndex(new BufferAttribute(corners, 1));
  const group = new Group();
  group.add(new Mesh(geometry, tiles()));
  return group;
}

/** What cells are drawn with. */
export const tiles = (): MeshLambertMaterial => new MeshLambertMaterial({ vertexColors: true, map: TILE });

/** The picture of a side: a darker edge, so that cells can be told apart. */
const TILE = tile();

function tile(): DataTexture {
  const n = 16;
  const bytes = new Uint8Array(4 * n * n).fill(255);
  for (let k = 0; k < n * n; k++) {
    const isEdge = k % n === 0 || k % n === n - 1 || k < n || k >= n * n - n;
    if (isEdge) bytes.fill(205, 4 * k, 4 * k + 3);
  }
  const found = new DataTexture(bytes, n, n);
  found.colorSpace = SRGBColorSpace;
  found.generateMipmaps = true;
  found.minFilter = LinearMipmapLinearFilter;
  found.magFilter = LinearFilter;
  found.needsUpdate = true;
  return found;
}

/** The pixels of a drawing in the plane, before it. */
export function sheet(header: Difference, marks: Uint8Array, colors: number[]): Group {
  const [columns, rows] = header.size;
  const texture = new DataTexture(pixels(marks, colors, 200), columns, rows);
  texture.flipY = true;
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  const [x, y] = [header.high[0] - header.low[0], header.high[1] - header.low[1]];
  const mesh = new Mesh(new PlaneGeometry(x, y), new MeshBasicMaterial({ map: texture, transparent: true }));
  mesh.position.set(header.low[0] + x / 2, header.low[1] + y / 2, 0.02 * y);
  const group = new Group();
  group.add(mesh);
  return group;
}

/** Red, green, blue and opacity of each mark. */
export function pixels(marks: Uint8Array, colors: number[], opacity: number): Uint8ClampedArray<ArrayBuffer> {
  const found = new Uint8ClampedArray(4 * marks.length);
  const bytes = colors.map((one) => new Color(one).getHex());
  marks.forEach((mark, k) => {
    const color = bytes[mark];
    if (mark > 0) found.set([color >> 16, (color >> 8) & 255, color & 255, opacity], 4 * k);
  });
  return found;
}
