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

/** Moves the camera to where the box just fits, with a margin (a share of the view). */
export function frame(camera: PerspectiveCamera, low: Vector3, high: Vector3, isFlat: boolean, margin = 0.06): Vector3 {
  const middle = low.clone().add(high).multiplyScalar(0.5);
  const away = isFlat ? FRONT : ALONG;
  const right = new Vector3().crossVectors(new Vector3(0, 1, 0), away).normalize();
  const up = new Vector3().crossVectors(away, right);
  const tall = Math.tan((camera.fov * Math.PI) / 360) * (1 - margin);
  const wide = tall * camera.aspect;
  let distance = 1e-3;
  for (let k = 0; k < 8; k++) {
    const corner = new Vector3(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z).sub(middle);
    const near = corner.dot(away);
    distance = Math.max(
      distance,
      near + Math.abs(corner.dot(right)) / wide,
      near + Math.abs(corner.dot(up)) / tall,
    );
  }
  camera.position.copy(middle).addScaledVector(away, distance);
  camera.near = distance / 100;
  camera.far = distance * 40;
  camera.lookAt(middle);
  camera.updateProjectionMatrix();
  return middle;
}
