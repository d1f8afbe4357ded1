"""Parts of solid targets: closed meshes over sections, boxes, balls and tubes.

Lengths are scene units, y is up. A target is a list of closed parts that may overlap.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki.targets.target import Target

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]

#: Digits after the point of a target's vertices: sines of different processors differ in far smaller ones.
DIGITS = 9


def solid(name: str, parts: Sequence[Mesh]) -> Target:
    """Make a target of closed parts, which may overlap; rounded, so that it has the same bytes on every processor."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    faces = [faces + start for (_, faces), start in zip(parts, starts, strict=False)]
    # A zero with a sign would depend on what is rounded away.
    vertices = np.round(np.concatenate([vertices for vertices, _ in parts]), DIGITS) + 0.0
    return Target(vertices, np.concatenate(faces), name)


def loft(sections: Sequence[ArrayLike], closed: bool = False) -> Mesh:
    """Stretch a closed skin over polygons (k, 3) with equally many corners.

    The first and the last are capped by fans (they should be star-shaped from their first corner), or, when the loft
    is `closed`, joined to one another.
    """
    rows = np.array(sections, dtype=np.float64)
    count, sides = rows.shape[:2]
    k = np.arange(sides)
    following = (k + 1) % sides
    faces = []
    for row in range(count if closed else count - 1):
        a, b = row * sides + k, row * sides + following
        up = ((row + 1) % count - row) * sides
        faces += [np.stack([a, b, b + up], axis=1), np.stack([a, b + up, a + up], axis=1)]
    if not closed:
        fan = np.stack([np.zeros(sides - 2, dtype=np.int64), k[1:-1], k[2:]], axis=1)
        faces += [fan[:, ::-1], fan + (count - 1) * sides]
    vertices, triangles = rows.reshape(-1, 3), np.concatenate(faces).astype(np.int64)
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    if np.einsum("ij,ij->i", a, np.cross(b, c)).sum() < 0.0:
        triangles = triangles[:, ::-1]
    return vertices, triangles


def rectangle(half: float, low: float, high: float, z: float) -> list[tuple[float, float, float]]:
    """Return the four corners of a rectangle across z."""
    return [(half, low, z), (half, high, z), (-half, high, z), (-half, low, z)]


def section(x: float, front: float, back: float, y: float, half: float) -> list[tuple[float, float, float]]:
    """Return the four corners of a rectangle across x."""
    return [(x, y - half, front), (x, y + half, front), (x, y + half, back), (x, y - half, back)]


def ring(center: ArrayLike, normal: ArrayLike, rx: float, ry: float, sides: int) -> NDArray[np.float64]:
    """Return corners (sides, 3) of an ellipse about `center`, across `normal`."""
    n = np.asarray(normal, dtype=np.float64) / np.linalg.norm(normal)
    side = np.cross([0.0, 0.0, 1.0] if abs(n[2]) < 0.9 else [0.0, 1.0, 0.0], n)
    side /= np.linalg.norm(side)
    turn = 2.0 * np.pi * np.arange(sides)[:, None] / sides
    return np.asarray(center + rx * np.cos(turn) * side + ry * np.sin(turn) * np.cross(n, side))


def tube(points: Sequence[ArrayLike], radii: Sequence[float], sides: int = 20, between: int = 4) -> Mesh:
    """Make a round tube along a Catmull-Rom curve through `points`."""
    p = np.array(points, dtype=np.float64)
    line = curve(p, between)
    widths = np.interp(np.arange(len(line)) / between, np.arange(len(p)), radii)
    along = np.gradient(line, axis=0)
    along[0] = [0.0, 1.0, 0.0] if p[0][1] == 0.0 else along[0]  # stand flat on the ground
    return loft([ring(c, n, r, r, sides) for c, n, r in zip(line, along, widths, strict=True)])


def cloud(center: ArrayLike, radii: tuple[float, float, float], sides: int = 28, rings: int = 13) -> Mesh:
    """Make a flattened ball, flatter below than above."""
    rx, ry, rz = radii
    sections = []
    for latitude in 0.5 * np.pi * np.sin(np.linspace(-0.48 * np.pi, 0.48 * np.pi, rings + 2)):
        height = np.sin(latitude) * ry * (0.55 if latitude < 0 else 1.15)
        turn = 2.0 * np.pi * np.arange(sides) / sides
        ring = [np.cos(turn) * rx, np.full(sides, height), np.sin(turn) * rz]
        ring[0], ring[2] = ring[0] * np.cos(latitude) ** 0.8, ring[2] * np.cos(latitude) ** 0.8
        sections.append(np.stack(ring, axis=1) + np.asarray(center))
    return loft(sections)


def block(low: ArrayLike, high: ArrayLike) -> Mesh:
    """Make a box from its low to its high corner."""
    x0, y0, z0 = np.asarray(low, dtype=np.float64)
    x1, y1, z1 = np.asarray(high, dtype=np.float64)
    floor = [(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)]
    return loft([floor, [(x, y1, z) for x, _, z in floor]])


def slab(outline: ArrayLike, low: float, high: float) -> Mesh:
    """Raise an outline (k, 2) in x and z from the height `low` to `high`."""
    x, z = np.asarray(outline, dtype=np.float64).T
    return loft([np.stack([x, np.full(len(x), y), z], axis=1) for y in (low, high)])


def ball(center: ArrayLike, radii: tuple[float, float, float], sides: int = 24, egg: float = 0.0) -> Mesh:
    """Make an ellipsoid; an `egg` is wider below its middle and narrower above by that share."""
    rx, ry, rz = radii
    turn = 2.0 * np.pi * np.arange(sides) / sides
    sections = []
    for latitude in np.linspace(-0.48 * np.pi, 0.48 * np.pi, sides // 2 + 1):
        wide = np.cos(latitude) * (1.0 - egg * np.sin(latitude))
        ring = [np.cos(turn) * rx * wide, np.full(sides, ry * np.sin(latitude)), np.sin(turn) * rz * wide]
        sections.append(np.stack(ring, axis=1) + np.asarray(center))
    return loft(sections)


def curve(points: ArrayLike, between: int = 4) -> NDArray[np.float64]:
    """Return points of a Catmull-Rom curve through `points` (n, d), with `between` steps from each to the next."""
    p = np.array(points, dtype=np.float64)
    padded = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
    path = []
    for i in range(len(p) - 1):
        a, b, c, d = padded[i : i + 4]
        for t in np.arange(between) / between:
            square, cube = (2 * a - 5 * b + 4 * c - d) * t**2, (3 * (b - c) + d - a) * t**3
            path.append(0.5 * (2 * b + (c - a) * t + square + cube))
    return np.array([*path, p[-1]])
