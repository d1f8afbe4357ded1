"""Closed parts as (vertices, faces), which may overlap, and what is measured of them. y is up."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import manifold3d
import numpy as np
from numpy.typing import NDArray

Part = tuple[NDArray[np.float64], NDArray[np.int64]]

#: The triangles of eight corners: four around the bottom, then four around the top.
CORNERS = np.array(
    [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4]]
    + [[1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]]
)
THINNEST = 1e-6


def block(low: Sequence[float], high: Sequence[float]) -> list[Part]:
    """A box between two corners; nothing if it has no thickness."""
    (x, y, z), (u, v, w) = low, high
    if min(u - x, v - y, w - z) < THINNEST:
        return []
    rows = [(x, y, z), (u, y, z), (u, v, z), (x, v, z), (x, y, w), (u, y, w), (u, v, w), (x, v, w)]
    return [(np.array(rows, float), CORNERS)]


def standing(x: float, y: float, z: float, width: float, height: float, depth: float) -> list[Part]:
    """A box above the middle of its bottom."""
    return block((x - width / 2, y, z - depth / 2), (x + width / 2, y + height, z + depth / 2))


def hexahedron(corners: Sequence[Sequence[float]]) -> list[Part]:
    return [(np.asarray(corners, float), CORNERS)]


def prism(outline: Any, low: float, high: float) -> list[Part]:
    """A convex polygon (x, y), counter-clockwise, from `low` to `high` along z."""
    points = np.asarray(outline, float)
    count = len(points)
    vertices = np.concatenate(
        [np.c_[points, np.full(count, low)], np.c_[points, np.full(count, high)]], axis=0
    )
    faces = []
    for i in range(1, count - 1):
        faces += [[0, i + 1, i], [count, count + i, count + i + 1]]
    for i in range(count):
        j = (i + 1) % count
        faces += [[i, j, count + j], [i, count + j, count + i]]
    return [(vertices, np.array(faces))]


def cylinder(x: float, y: float, z: float, radius: float, height: float, sides: int = 16) -> list[Part]:
    """An upright cylinder above the middle of its bottom."""
    angles = 2 * np.pi * np.arange(sides) / sides
    ((vertices, faces),) = prism(np.c_[np.cos(angles), np.sin(angles)] * radius, y, y + height)
    return [(np.c_[vertices[:, 1] + x, vertices[:, 2], vertices[:, 0] + z], faces)]


def lathe(radii: Any, heights: Any, x: float = 0.0, z: float = 0.0, sides: int = 24) -> list[Part]:
    """A solid of revolution about an upright axis, from rows of radii at rising heights."""
    angles = 2 * np.pi * np.arange(sides) / sides
    radii, heights = np.asarray(radii, float), np.asarray(heights, float)
    rows = len(radii)
    vertices = np.empty((rows, sides, 3))
    vertices[..., 0] = x + radii[:, None] * np.cos(angles)
    vertices[..., 1] = heights[:, None]
    vertices[..., 2] = z - radii[:, None] * np.sin(angles)
    ends = [[x, heights[0], z], [x, heights[-1], z]]
    low, high = rows * sides, rows * sides + 1
    faces = []
    for j in range(sides):
        k = (j + 1) % sides
        for row in range(0, (rows - 1) * sides, sides):
            faces += [[row + j, row + k, row + sides + k], [row + j, row + sides + k, row + sides + j]]
        faces += [[low, k, j], [high, low - sides + j, low - sides + k]]
    return [(np.concatenate([vertices.reshape(-1, 3), ends]), np.array(faces))]


def tube(points: Sequence[Sequence[float]], thickness: float) -> list[Part]:
    """Square bars of one thickness between points, each longer by half of it at both ends."""
    parts: list[Part] = []
    for start, end in zip(points[:-1], points[1:], strict=True):
        a, b = np.asarray(start, float), np.asarray(end, float)
        along = (b - a) / max(float(np.linalg.norm(b - a)), THINNEST)
        side = np.cross(along, (0, 0, 1) if abs(along[2]) < 0.9 else (0, 1, 0))
        side /= np.linalg.norm(side)
        up = np.cross(side, along)
        half = thickness / 2
        offsets = [(-half, -half), (half, -half), (half, half), (-half, half)]
        corners = [
            end + u * side + v * up for end in (a - half * along, b + half * along) for u, v in offsets
        ]
        # Side, up and along are left-handed, so the faces turn round.
        parts.append((np.array(corners), CORNERS[:, ::-1]))
    return parts


def of_manifold(solid: manifold3d.Manifold) -> list[Part]:
    mesh = solid.to_mesh()
    vertices, faces = np.asarray(mesh.vert_properties[:, :3], float), np.asarray(mesh.tri_verts, np.int64)
    return [(vertices, faces)] if len(faces) else []


def union(parts: Sequence[Part]) -> manifold3d.Manifold:
    """The exact union of closed parts."""
    solids = []
    for vertices, faces in parts:
        mesh = manifold3d.Mesh(np.asarray(vertices, np.float32), np.asarray(faces, np.uint32))
        solid = manifold3d.Manifold(mesh)
        if solid.status() != manifold3d.Error.NoError:
            raise ValueError(f"a part is not a solid: {solid.status()}")
        solids.append(solid)
    return (
        manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add) if solids else manifold3d.Manifold()
    )


def intersection_over_union(first: manifold3d.Manifold, second: manifold3d.Manifold) -> float:
    common = (first ^ second).volume()
    return float(common / max(first.volume() + second.volume() - common, 1e-30))
