// The difference from a target: its cells, in the colours of the legend.

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

/** Colours of cells of target and scene, of the target only, of the scene only. */
export const KINDS = {
  light: [0, 0xaaa69c, 0x3f7fc0, 0xd0652b],
  dark: [0, 0x6d6e73, 0x6aa9e6, 0xf08a4b],
};

/** The sides of a cell: the step to its neighbour, and the corners, counter-clockwise from outside. */
const SIDES = [0, 1, 2].flatMap((axis) =>
  [0, 1].map((end) => {
    const corner = (u: number, v: number) => {
      const place = [0, 0, 0];
      [place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]] = [end, u, v];
      return place;
    };
    const step = [0, 0, 0];
    step[axis] = 2 * end - 1;
    const around = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
    return { step, corners: end === 1 ? around : around.reverse() };
  }),
);
/** Texture coordinates of the corners of a side. */
const EDGES = [0, 0, 1, 0, 1, 1, 0, 1];

/** Makes the visible sides of cells: those beside an empty cell. */
export function cubes({ size, low, high }: Difference, marks: Uint8Array, colors: number[]): Group {
  const [nx, ny, nz] = size;
  const at = (x: number, y: number, z: number) =>
    x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz ? 0 : marks[(z * ny + y) * nx + x];
  const visible: number[] = [];
  for (let z = 0, k = 0; z < nz; z++) {
    for (let y = 0; y < ny; y++) {
      for (let x = 0; x < nx; x++, k++) {
        if (marks[k] === 0) continue;
        SIDES.forEach(({ step }, side) => {
          if (at(x + step[0], y + step[1], z + step[2]) === 0) visible.push(x, y, z, side);
        });
      }
    }
  }
  const n = visible.length / 4;
  const [places, normals, shades, edges] = [12, 12, 12, 8].map((width) => new Float32Array(width * n));
  const corners = new Uint32Array(6 * n);
  const widths = high.map((end, axis) => (end - low[axis]) / size[axis]);
  const paint = colors.map((color) => new Color(color));
  for (let k = 0; k < n; k++) {
    const [x, y, z, side] = visible.slice(4 * k, 4 * k + 4);
    const color = paint[at(x, y, z)];
    SIDES[side].corners.forEach((corner, c) => {
      const first = 12 * k + 3 * c;
      [x, y, z].forEach((cell, axis) => (places[first + axis] = low[axis] + (cell + corner[axis]) * widths[axis]));
      normals.set(SIDES[side].step, first);
      shades.set([color.r, color.g, color.b], first);
    });
    edges.set(EDGES, 8 * k);
    corners.set([0, 1, 2, 0, 2, 3].map((corner) => 4 * k + corner), 6 * k);
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

/** The material of cells. */
export const tiles = (): MeshLambertMaterial => new MeshLambertMaterial({ vertexColors: true, map: TILE });

/** The texture of a side: a darker edge, so that cells can be distinguished. */
const TILE = tile();

function tile(): DataTexture {
  const n = 16;
  const bytes = new Uint8Array(4 * n * n).fill(255);
  for (let k = 0; k < n * n; k++) {
    const isEdge = k % n === 0 || k % n === n - 1 || k < n || k >= n * n - n;
    if (isEdge) bytes.fill(205, 4 * k, 4 * k + 3);
  }
  const texture = new DataTexture(bytes, n, n);
  texture.colorSpace = SRGBColorSpace;
  texture.generateMipmaps = true;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Makes a sheet with the pixels in front of a drawing in the plane. */
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

/** Converts marks to red, green, blue and opacity. */
export function pixels(marks: Uint8Array, colors: number[], opacity: number): Uint8ClampedArray<ArrayBuffer> {
  const image = new Uint8ClampedArray(4 * marks.length);
  const bytes = colors.map((color) => new Color(color).getHex());
  marks.forEach((mark, k) => {
    const color = bytes[mark];
    if (mark > 0) image.set([color >> 16, (color >> 8) & 255, color & 255, opacity], 4 * k);
  });
  return image;
}
