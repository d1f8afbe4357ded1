"""Furnishings made by code: a table, a chair, a plate, a cup. In metres, y is up, and the floor is at y = 0.

Each is a list of closed parts around the y axis. A part is vertices (n, 3) and faces (m, 3). A chair faces +z. Plate
and cup also stand on y = 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, hypot, pi, sin

from niwaki.words import Vec

Vertex = tuple[float, float, float]
Face = tuple[int, int, int]
Part = tuple[tuple[Vertex, ...], tuple[Face, ...]]


def up_radius(parts: Sequence[Part]) -> float:
    """Return the radius of the upright bounding cylinder around the y axis."""
    return max(hypot(x, z) for vertices, _ in parts for x, _, z in vertices)


def table() -> list[Part]:
    """Make a round table on a column."""
    top = lathe(
        [(0.0, 0.715), (0.36, 0.715), (0.385, 0.725), (0.385, 0.745), (0.375, 0.755), (0.0, 0.755)], 40
    )
    foot = [
        (0.0, 0.0),
        (0.22, 0.0),
        (0.22, 0.015),
        (0.05, 0.04),
        (0.028, 0.1),
        (0.028, 0.64),
        (0.09, 0.715),
        (0.0, 0.715),
    ]
    return [top, lathe(foot, 24)]


def chair() -> list[Part]:
    """Make a chair with four legs and a back, facing +z."""
    seat = slab([(-0.18, 0.42, 0.19), (0.18, 0.42, 0.19), (0.165, 0.42, -0.18), (-0.165, 0.42, -0.18)], 0.035)
    legs = [
        slab(
            [
                (x - 0.018, 0.0, z + 0.018),
                (x + 0.018, 0.0, z + 0.018),
                (x + 0.018, 0.0, z - 0.018),
                (x - 0.018, 0.0, z - 0.018),
            ],
            0.42,
        )
        for x, z in ((-0.15, 0.16), (0.15, 0.16), (-0.14, -0.155), (0.14, -0.155))
    ]
    posts = [
        slab(
            [
                (x - 0.016, 0.455, -0.145),
                (x + 0.016, 0.455, -0.145),
                (x + 0.016, 0.455, -0.177),
                (x - 0.016, 0.455, -0.177),
            ],
            0.36,
        )
        for x in (-0.145, 0.145)
    ]
    rail = slab([(-0.17, 0.66, -0.14), (0.17, 0.66, -0.14), (0.17, 0.66, -0.172), (-0.17, 0.66, -0.172)], 0.2)
    return [seat, *legs, *posts, rail]


def plate() -> list[Part]:
    """Make a plate with a raised rim."""
    return [lathe([(0.0, 0.0), (0.06, 0.0), (0.1, 0.016), (0.1, 0.02), (0.062, 0.007), (0.0, 0.007)], 32)]


def cup() -> list[Part]:
    """Make a cup without a handle: a wall and a bottom."""
    profile = [
        (0.0, 0.0),
        (0.028, 0.0),
        (0.036, 0.03),
        (0.039, 0.075),
        (0.035, 0.075),
        (0.032, 0.032),
        (0.025, 0.008),
        (0.0, 0.008),
    ]
    return [lathe(profile, 24)]


def walls(inner: Sequence[Vec], outer: Sequence[Vec], height: float) -> list[Part]:
    """Make a wall between two outlines of a floor plan, a part for each edge.

    Parameters
    ----------
    inner, outer
        Polygons with the same number of corners, counter-clockwise, in the plan's x and y.
    height
        The wall's height.
    """
    pieces = []
    for n, a in enumerate(inner):
        m = (n + 1) % len(inner)
        quad = (outer[n], outer[m], inner[m], a)
        pieces.append(slab([(x, 0.0, -y) for x, y in quad], height))
    return pieces


def lathe(profile: Sequence[tuple[float, float]], around: int) -> Part:
    """Make a body of revolution about the y axis.

    Parameters
    ----------
    profile
        Points (radius, height) from the axis outwards, upwards and back to the axis; first and last radius 0.
    around
        The number of sides.
    """
    (_, low), *rings, (_, high) = profile
    vertices: list[Vertex] = [(0.0, low, 0.0)]
    for radius, height in rings:
        for k in range(around):
            angle = 2.0 * pi * k / around
            vertices.append((radius * cos(angle), height, -radius * sin(angle)))
    vertices.append((0.0, high, 0.0))
    last, faces = len(vertices) - 1, []
    for k in range(around):
        after = (k + 1) % around
        faces.append((0, 1 + after, 1 + k))
        for ring in range(len(rings) - 1):
            a, b = 1 + ring * around, 1 + (ring + 1) * around
            faces += [(a + k, a + after, b + after), (a + k, b + after, b + k)]
        top = 1 + (len(rings) - 1) * around
        faces.append((last, top + k, top + after))
    return tuple(vertices), tuple(faces)


def slab(bottom: Sequence[Vertex], thick: float) -> Part:
    """Make a plate of thickness `thick` on a convex outline, counter-clockwise seen from above."""
    count = len(bottom)
    vertices = (*bottom, *((x, y + thick, z) for x, y, z in bottom))
    faces: list[Face] = []
    for k in range(1, count - 1):
        faces += [(0, k + 1, k), (count, count + k, count + k + 1)]
    for k in range(count):
        after = (k + 1) % count
        faces += [(k, after, count + after), (k, count + after, count + k)]
    return vertices, tuple(faces)
