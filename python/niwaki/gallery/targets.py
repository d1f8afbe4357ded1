"""Targets of our own design, made by code: a ship's hull, a crescent of buildings, a cloud-pruned tree.

Each is a list of closed parts that may overlap. All lengths are scene units, y is up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki.target import Target

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def ship() -> Target:
    """Make a ship's hull about 18 wide, 3 high and 15 long; nose towards +z.

    A fuselage that narrows to a blunt nose and to the tail, a low slab on its back, two-part wings that sweep
    back and droop a little, and long six-sided engine pods at their ends.
    """
    # Fuselage: rectangles across z as (z, half width, lowest y, highest y).
    hull = [(-5.2, 1.0, -0.65, 0.75), (-4.4, 1.5, -0.95, 1.05), (1.6, 1.5, -1.0, 1.1), (3.6, 1.1, -0.8, 0.75)]
    hull.append((5.4, 0.45, -0.45, 0.15))
    fuselage = _loft([_rectangle(w, low, high, z) for z, w, low, high in hull])
    slab = _loft(
        [
            _rectangle(w, 0.9, high, z)
            for z, w, high in [(-4.0, 0.75, 1.45), (-0.2, 0.75, 1.75), (0.9, 0.5, 1.3)]
        ]
    )
    parts = [fuselage, slab]
    for side in (1.0, -1.0):
        # Wings: sections across x as (x, front z, back z, middle y, half thickness).
        wing = [(1.2, 0.6, -3.4, 0.0, 0.45), (4.2, -1.0, -4.6, 0.05, 0.38), (8.0, -4.2, -7.0, -0.15, 0.30)]
        parts.append(_loft([_section(side * x, z0, z1, y, t) for x, z0, z1, y, t in wing]))
        pod = [(-9.6, 0.45), (-9.0, 0.8), (-3.4, 0.8), (-2.0, 0.35)]
        parts.append(_loft([_ring((side * 8.2, -0.15, z), (0, 0, 1), r, r, 6) for z, r in pod]))
    return _target("ship", parts)


def crescent() -> Target:
    """Make a crescent open to +z, 25 wide: a low wall that rises to a tower in the middle."""
    steps = 24
    sections = []
    for angle in np.linspace(-0.62 * np.pi, 0.62 * np.pi, steps + 1):
        bend = abs(angle) / (0.62 * np.pi)
        middle = np.exp(-((bend / 0.16) ** 4))
        end = 1.0 / (1.0 + np.exp(-(bend - 0.86) / 0.03))
        height = 2.6 + 9.4 * middle + 3.2 * end
        thick = 1.5 + 0.6 * middle + 0.3 * end
        out = np.array([np.sin(angle), 0.0, -np.cos(angle)])
        inner, outer = out * (11.0 - thick), out * (11.0 + thick)
        up = np.array([0.0, height, 0.0])
        sections.append(np.array([outer, inner, inner + up, outer + up]) + [0.0, 0.0, 8.0])
    return _target("crescent", [_loft(sections)])


def niwaki() -> Target:
    """Make a cloud-pruned garden tree 20 high: an S-bent leaning trunk, limbs, five flat clouds."""
    trunk = _tube(
        [(0, 0, 0), (0.5, 2.2, 0.1), (1.9, 4.8, 0.3), (2.6, 7.4, 0.3), (1.6, 10.2, 0.0), (-0.6, 12.8, -0.4)]
        + [(-1.6, 15.0, -0.5), (-1.2, 17.2, -0.4)],
        [1.75, 1.45, 1.3, 1.15, 1.0, 0.85, 0.7, 0.55],
    )
    limbs = [
        _tube([(2.3, 5.9, 0.3), (4.4, 6.9, 0.9), (6.4, 7.4, 1.3)], [0.75, 0.6, 0.5]),
        _tube([(2.3, 8.4, 0.2), (0.0, 9.3, 1.2), (-2.8, 9.6, 1.7)], [0.7, 0.6, 0.45]),
        _tube([(0.6, 11.6, -0.2), (2.8, 12.6, -0.8), (4.6, 12.9, -1.2)], [0.6, 0.5, 0.4]),
        _tube([(-1.3, 14.0, -0.4), (-3.4, 14.6, -1.0), (-4.8, 14.8, -1.3)], [0.5, 0.45, 0.4]),
    ]
    clouds = [
        _cloud((6.7, 8.0, 1.4), (3.1, 1.2, 3.0)),
        _cloud((-3.9, 10.2, 1.8), (3.0, 1.15, 2.8)),
        _cloud((5.0, 13.5, -1.4), (2.6, 1.1, 2.5)),
        _cloud((-5.2, 15.2, -1.4), (2.3, 1.05, 2.2)),
        _cloud((-0.9, 18.2, -0.4), (3.0, 1.5, 2.8)),
    ]
    return _target("niwaki", [trunk, *limbs, *clouds])


TARGETS: dict[str, Callable[[], Target]] = {"ship": ship, "crescent": crescent, "niwaki": niwaki}


def write_all(folder: str | PathLike[str]) -> list[Path]:
    """Write every target into a folder as an OBJ file and return their paths."""
    place = Path(folder)
    place.mkdir(parents=True, exist_ok=True)
    written = []
    for name, make in TARGETS.items():
        target = make()
        lines = [f"# niwaki target: {name}", f"o {name}"]
        lines += ["v " + " ".join(f"{c:.6f}" for c in vertex) for vertex in target.vertices]
        lines += ["f " + " ".join(str(i + 1) for i in face) for face in target.faces]
        path = place / f"{name}.obj"
        path.write_text("\n".join(lines) + "\n", encoding="ascii")
        written.append(path)
    return written


def _target(name: str, parts: Sequence[Mesh]) -> Target:
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    faces = [faces + start for (_, faces), start in zip(parts, starts, strict=False)]
    return Target(np.concatenate([vertices for vertices, _ in parts]), np.concatenate(faces), name)


def _loft(sections: Sequence[ArrayLike]) -> Mesh:
    """Stretch a closed skin over polygons (k, 3) with equally many corners, capped by fans."""
    rows = np.array(sections, dtype=np.float64)
    count, sides = rows.shape[:2]
    k = np.arange(sides)
    following = (k + 1) % sides
    faces = []
    for row in range(count - 1):
        a, b = row * sides + k, row * sides + following
        faces += [np.stack([a, b, b + sides], axis=1), np.stack([a, b + sides, a + sides], axis=1)]
    fan = np.stack([np.zeros(sides - 2, dtype=np.int64), k[1:-1], k[2:]], axis=1)
    faces += [fan[:, ::-1], fan + (count - 1) * sides]
    vertices, triangles = rows.reshape(-1, 3), np.concatenate(faces).astype(np.int64)
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    if np.einsum("ij,ij->i", a, np.cross(b, c)).sum() < 0.0:
        triangles = triangles[:, ::-1]
    return vertices, triangles


def _rectangle(half: float, low: float, high: float, z: float) -> list[tuple[float, float, float]]:
    return [(half, low, z), (half, high, z), (-half, high, z), (-half, low, z)]


def _section(x: float, front: float, back: float, y: float, half: float) -> list[tuple[float, float, float]]:
    return [(x, y - half, front), (x, y + half, front), (x, y + half, back), (x, y - half, back)]


def _ring(center: ArrayLike, normal: ArrayLike, rx: float, ry: float, sides: int) -> NDArray[np.float64]:
    n = np.asarray(normal, dtype=np.float64) / np.linalg.norm(normal)
    side = np.cross([0.0, 0.0, 1.0] if abs(n[2]) < 0.9 else [0.0, 1.0, 0.0], n)
    side /= np.linalg.norm(side)
    turn = 2.0 * np.pi * np.arange(sides)[:, None] / sides
    return np.asarray(center + rx * np.cos(turn) * side + ry * np.sin(turn) * np.cross(n, side))


def _tube(points: Sequence[ArrayLike], radii: Sequence[float], sides: int = 20, between: int = 4) -> Mesh:
    """Make a round tube along a Catmull-Rom curve through `points`."""
    p = np.array(points, dtype=np.float64)
    padded = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
    path, widths = [], []
    for i in range(len(p) - 1):
        a, b, c, d = padded[i : i + 4]
        last = i == len(p) - 2
        for t in np.linspace(0.0, 1.0, between + 1)[: between + 1 if last else between]:
            path.append(
                0.5
                * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * (b - c) + d - a) * t**3)
            )
            widths.append(radii[i] * (1 - t) + radii[i + 1] * t)
    line = np.array(path)
    along = np.gradient(line, axis=0)
    along[0] = [0.0, 1.0, 0.0] if p[0][1] == 0.0 else along[0]  # stand flat on the ground
    return _loft([_ring(c, n, r, r, sides) for c, n, r in zip(line, along, widths, strict=True)])


def _cloud(center: ArrayLike, radii: tuple[float, float, float], sides: int = 28, rings: int = 13) -> Mesh:
    """Make a flattened ball, flatter below than above."""
    rx, ry, rz = radii
    sections = []
    for latitude in 0.5 * np.pi * np.sin(np.linspace(-0.48 * np.pi, 0.48 * np.pi, rings + 2)):
        height = np.sin(latitude) * ry * (0.55 if latitude < 0 else 1.15)
        turn = 2.0 * np.pi * np.arange(sides) / sides
        ring = [np.cos(turn) * rx, np.full(sides, height), np.sin(turn) * rz]
        ring[0], ring[2] = ring[0] * np.cos(latitude) ** 0.8, ring[2] * np.cos(latitude) ** 0.8
        sections.append(np.stack(ring, axis=1) + np.asarray(center))
    return _loft(sections)
