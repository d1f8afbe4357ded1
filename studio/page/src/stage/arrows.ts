// Forces as arrows, visible through the blocks.

import { ConeGeometry, CylinderGeometry, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import type { Arrow } from "../messages";

const UP = new Vector3(0, 1, 0);

/** Makes a shaft and a head for each force; the largest arrow is `longest` long, and thickness follows length. */
export function arrowMeshes(forces: Arrow[], longest: number, color: number): Mesh[] {
  const most = Math.max(...forces.map((arrow) => Math.hypot(...arrow.force)), 1e-12);
  return forces.flatMap((arrow) => {
    const force = new Vector3(...arrow.force);
    const length = (longest * force.length()) / most;
    const head = Math.min(0.16 * longest, 0.5 * length);
    const wide = 0.026 * longest * (0.5 + (0.5 * length) / longest);
    const shaft = new CylinderGeometry(wide, wide, length - head, 12).translate(0, (length - head) / 2, 0);
    const tip = new ConeGeometry(2.6 * wide, head, 16).translate(0, length - head / 2, 0);
    const turn = new Quaternion().setFromUnitVectors(UP, force.normalize());
    return [shaft, tip].map((geometry) => {
      const material = new MeshBasicMaterial({ color, transparent: true, opacity: 0.85, depthTest: false });
      const mesh = new Mesh(geometry, material);
      mesh.quaternion.copy(turn);
      mesh.position.set(...arrow.at);
      mesh.renderOrder = 10;
      return mesh;
    });
  });
}
