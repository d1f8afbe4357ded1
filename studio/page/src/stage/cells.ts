// The difference to a target: the cells that border on another kind, as small cubes in the colours of the legend.

import {
  BoxGeometry,
  Color,
  DataTexture,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  NearestFilter,
  PlaneGeometry,
  SRGBColorSpace,
  Vector3,
} from "three";
import type { Difference } from "../messages";

/** Of what is wanted and filled, wanted only, filled only. */
export const KINDS = {
  light: [0, 0xaaa69c, 0x3f7fc0, 0xd0652b],
  dark: [0, 0x6d6e73, 0x6aa9e6, 0xf08a4b],
};

export function cubes({ size, low, high }: Difference, marks: Uint8Array, colors: number[]): Group {
  const [nx, ny, nz] = size;
  const step = new Vector3(...high).sub(new Vector3(...low)).divide(new Vector3(nx, ny, nz));
  const at = (x: number, y: number, z: number) =>
    x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz ? 0 : marks[(z * ny + y) * nx + x];
  const places: number[][] = [[], [], [], []];
  for (let z = 0, k = 0; z < nz; z++) {
    for (let y = 0; y < ny; y++) {
      for (let x = 0; x < nx; x++, k++) {
        const kind = marks[k];
        if (kind === 0) continue;
        const isInner =
          at(x - 1, y, z) === kind &&
          at(x + 1, y, z) === kind &&
          at(x, y - 1, z) === kind &&
          at(x, y + 1, z) === kind &&
          at(x, y, z - 1) === kind &&
          at(x, y, z + 1) === kind;
        if (!isInner) places[kind].push(x, y, z);
      }
    }
  }
  const group = new Group();
  const matrix = new Matrix4();
  for (const kind of [1, 2, 3]) {
    const found = places[kind];
    const cube = new BoxGeometry(0.9 * step.x, 0.9 * step.y, 0.9 * step.z);
    const mesh = new InstancedMesh(cube, new MeshLambertMaterial({ color: colors[kind] }), found.length / 3);
    for (let k = 0; k < found.length / 3; k++) {
      matrix.makeTranslation(
        low[0] + (found[3 * k] + 0.5) * step.x,
        low[1] + (found[3 * k + 1] + 0.5) * step.y,
        low[2] + (found[3 * k + 2] + 0.5) * step.z,
      );
      mesh.setMatrixAt(k, matrix);
    }
    group.add(mesh);
  }
  return group;
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
