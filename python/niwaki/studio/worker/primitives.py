"""Primitive targets: a box, a ball and a column of unit size, which stand on the ground.

A library for meshes would take longer to load than the rest of a worker.
"""

from __future__ import annotations

import numpy as np

from niwaki.targets.examples.lofts import Mesh, block, slab, solid
from niwaki.targets.target import Target

#: The triangles of an icosahedron with the corners of `_icosahedron`, counter-clockwise seen from outside.
ICOSAHEDRON = (
    *((0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2)),
    *((10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5)),
    *((2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)),
)


def box() -> Mesh:
    """Make a cube."""
    return block((-0.5, 0.0, -0.5), (0.5, 1.0, 0.5))


def ball(divisions: int = 3) -> Mesh:
    """Make a ball: an icosahedron whose triangles are divided into four, with all corners moved to the sphere."""
    points, faces = _icosahedron()
    for _ in range(divisions):
        points, faces = _divided((points, faces))
        points *= 0.5 / np.linalg.norm(points, axis=1, keepdims=True)
    points[:, 1] -= points[:, 1].min()
    return points, faces


def column(sides: int = 48) -> Mesh:
    """Make a cylinder about the y axis."""
    turn = 2.0 * np.pi * np.arange(sides) / sides
    return slab(np.stack([0.5 * np.cos(turn), -0.5 * np.sin(turn)], axis=1), 0.0, 1.0)


PRIMITIVES = {"box": box, "ball": ball, "column": column}


def primitive(name: str) -> Target:
    """Return a primitive as a target."""
    return solid(name, [PRIMITIVES[name]()])


def _icosahedron() -> Mesh:
    """Return an icosahedron: the corners of three golden rectangles across one another."""
    golden = (1.0 + 5.0**0.5) / 2.0
    rectangle = np.array([(x, y, 0.0) for y in (golden, -golden) for x in (-1.0, 1.0)])
    points = np.concatenate([np.roll(rectangle, turn, axis=1) for turn in range(3)])
    return points, np.array(ICOSAHEDRON, dtype=np.int64)


def _divided(mesh: Mesh) -> Mesh:
    """Divide each triangle into four, by the middles of its edges."""
    points, faces = mesh
    edges = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    unique, number = np.unique(edges, axis=0, return_inverse=True)
    (a, b, c), (ab, bc, ca) = faces.T, number.reshape(-1, 3).T + len(points)
    quarters = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    corners = np.concatenate([np.stack(quarter, axis=1) for quarter in quarters])
    return np.concatenate([points, points[unique].mean(axis=1)]), corners
