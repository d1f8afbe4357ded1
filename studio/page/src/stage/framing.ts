// The position of a camera that sees a box, along the direction of all pictures.

import { Box3, PerspectiveCamera, Vector3 } from "three";

export const ALONG = new Vector3(0.62, 0.44, 0.78).normalize();
const FRONT = new Vector3(0, 0, 1);

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7];

/** Whether a camera sees all of a box. */
export function isSeen(camera: PerspectiveCamera, { min, max }: Box3): boolean {
  camera.updateMatrixWorld();
  return CORNERS.every((k) => {
    const at = new Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z).project(camera);
    return Math.max(Math.abs(at.x), Math.abs(at.y), Math.abs(at.z)) <= 1;
  });
}

/** Shares of the view's height that stay free at the top and at the bottom. */
interface Free {
  top: number;
  bottom: number;
}

/** Moves the camera to where the box just fits, with a margin (a share of the view); returns the point in the middle. */
export function frame(
  camera: PerspectiveCamera,
  low: Vector3,
  high: Vector3,
  isFlat: boolean,
  margin = 0.06,
  free: Free = { top: 0, bottom: 0 },
): Vector3 {
  const middle = low.clone().add(high).multiplyScalar(0.5);
  const away = isFlat ? FRONT : ALONG;
  const right = new Vector3().crossVectors(new Vector3(0, 1, 0), away).normalize();
  const up = new Vector3().crossVectors(away, right);
  const tall = Math.tan((camera.fov * Math.PI) / 360);
  const [above, below] = [tall * (1 - margin - 2 * free.top), tall * (1 - margin - 2 * free.bottom)];
  const wide = tall * camera.aspect * (1 - margin);
  const corners = CORNERS.map((k) => {
    const corner = new Vector3(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z).sub(middle);
    return { near: corner.dot(away), x: corner.dot(right), y: corner.dot(up) };
  });
  // For each two corners, one at each edge of the view: the distance from which both are seen.
  let distance = 1e-3;
  for (const a of corners) {
    for (const b of corners) {
      distance = Math.max(
        distance,
        a.near + 1e-3,
        (a.x - b.x + wide * (a.near + b.near)) / (2 * wide),
        (a.y - b.y + above * a.near + below * b.near) / (above + below),
      );
    }
  }
  // The contents are in the middle of the free part: both edges have the same share of room left.
  const centre = (at: (corner: (typeof corners)[0]) => number, plus: number, minus: number) => {
    const pairs = corners.flatMap((a) => corners.map((b) => (at(a) - at(b)) / (plus * (distance - a.near) + minus * (distance - b.near))));
    const share = Math.max(...pairs);
    return Math.max(...corners.map((corner) => at(corner) - share * plus * (distance - corner.near)));
  };
  middle.addScaledVector(right, centre(({ x }) => x, wide, wide)).addScaledVector(up, centre(({ y }) => y, above, below));
  camera.position.copy(middle).addScaledVector(away, distance);
  camera.near = distance / 100;
  camera.far = distance * 40;
  camera.lookAt(middle);
  camera.updateProjectionMatrix();
  return middle;
}
