"""Triangulation of polygons: triangles cover a polygon and nothing else.

A fan (the triangles from one corner to all others) covers a polygon if all its triangles face as the polygon does. Fans
cover every convex polygon, and many others. Ear clipping (mapbox_earcut) cuts the rest. In a polygon that touches
itself, such as one with a cut that leads to a hole, it may skip corners on straight lines. The neighbouring polygon
needs these corners. Triangles without area restore them, so that a closed surface stays closed.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from mapbox_earcut import triangulate_float64
from numpy.typing import NDArray

from niwaki.inputs.limits import beyond, limit
from niwaki.targets.pieces import check_corners

#: The tolerance for triangles of a fan that face away, as a share of the polygon's area.
_AWAY = 1e-9


def triangles(
    vertices: NDArray[np.float64], corners: NDArray[np.int64], counts: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Cut polygons into triangles, in the order of the polygons.

    Parameters
    ----------
    vertices : (n, 3) float64
    corners : (k,) int64
        Vertex numbers, polygon after polygon.
    counts : (m,) int64
        The number of corners of each polygon. Polygons with one or two have no triangles.

    Raises
    ------
    Unreadable
        A corner names no vertex.
    FileError
        The concave polygons have too many corners.
    """
    check_corners(corners, len(vertices))
    starts = np.cumsum(counts) - counts
    pieces, owners = [np.empty((0, 3), np.int64)], [np.empty(0, np.int64)]
    comparisons, budget = 0, limit("comparisons") + 100 * len(corners)
    for count in np.unique(counts[counts >= 3]).tolist():
        numbers = np.flatnonzero(counts == count)
        rows = corners[starts[numbers, None] + np.arange(count)]
        # A quad is covered by its fan from the first corner or from the second.
        for first in (0, 1):
            cut = fans(np.roll(rows, -first, axis=1))
            cover = _cover(vertices, cut) if count > 3 else np.ones(len(rows), bool)
            pieces.append(cut[cover].reshape(-1, 3))
            owners.append(np.repeat(numbers[cover], count - 2))
            rows, numbers = rows[~cover], numbers[~cover]
        comparisons += count * count * len(rows)
        if comparisons > budget:
            raise beyond(
                "comparisons", f"cutting its concave polygons, one of {count:,} corners, takes more", None
            )
        for row, owner in zip(rows, numbers, strict=True):
            pieces.append(row[_clipped(vertices[row])])
            owners.append(np.full(len(pieces[-1]), owner))
    return np.concatenate(pieces)[np.argsort(np.concatenate(owners), kind="stable")]


def fans(rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return triangles (m, k, 3) from the first corner of each row to all others."""
    return np.stack([np.broadcast_to(rows[:, :1], rows[:, 2:].shape), rows[:, 1:-1], rows[:, 2:]], axis=2)


def strips(corners: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return triangles of strips, which end at -1: each corner with the two before it, every second turned over."""
    if len(corners) < 3:
        return np.empty((0, 3), np.int64)
    faces = np.stack([corners[:-2], corners[1:-1], corners[2:]], axis=1)
    number = np.arange(len(corners))
    first = np.maximum.accumulate(np.where(corners < 0, number + 1, 0))[:-2]
    odd = (number[:-2] - first) % 2 == 1
    faces[odd] = faces[odd][:, [1, 0, 2]]
    return faces[(faces >= 0).all(axis=1)]


def _cover(vertices: NDArray[np.float64], fans: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return whether the triangles of each fan (m, k, 3) cover its polygon and nothing else."""
    a, b, c = (vertices[fans[:, :, k]] for k in range(3))
    with np.errstate(all="ignore"):
        areas = np.cross(b - a, c - a)
        whole = areas.sum(axis=1)
        along = np.einsum("mkx,mx->mk", areas, whole)
        away = along < -_AWAY * (whole * whole).sum(axis=1, keepdims=True)
    # Numbers that are not finite pass: `Target` refuses them.
    return np.asarray(~away.any(axis=1) | ~np.isfinite(along).all(axis=1))


def _clipped(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Clip a polygon (n, 3) into triangles of its corner numbers. Their borders add up to the polygon's."""
    centred = points - points[0]
    area = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
    # The projection along the axis that it faces most has the same triangles, and rounds no coordinate.
    axis = int(np.abs(area).argmax())
    flat = np.ascontiguousarray(np.delete(centred, axis, axis=1))
    ears = triangulate_float64(flat, np.array([len(flat)], np.uint32)).reshape(-1, 3).astype(np.int64)
    a, b, c = (centred[ears[:, k]] for k in range(3))
    if (np.cross(b - a, c - a).sum(axis=0) * area)[axis] < 0.0:
        ears = ears[:, ::-1]
    return np.array([*ears.tolist(), *_missing(len(points), ears)], np.int64).reshape(-1, 3)


def _missing(count: int, ears: NDArray[np.int64]) -> list[list[int]]:
    """Return triangles between the border of `ears` and the border of the polygon 0, 1, ..., `count` - 1."""
    uses: dict[tuple[int, int], int] = defaultdict(int)
    ring = [(k, (k + 1) % count) for k in range(count)]
    for a, b in [*ring, *((b, a) for t in ears.tolist() for a, b in zip(t, t[1:] + t[:1], strict=True))]:
        uses[min(a, b), max(a, b)] += 1 if a < b else -1
    after: dict[int, list[int]] = defaultdict(list)
    for (a, b), times in uses.items():
        after[a if times > 0 else b] += [b if times > 0 else a] * abs(times)
    faces = []
    for start in list(after):
        path = [start]
        # Each vertex has as many edges in as out, so every walk closes; each loop leaves the path.
        while after[path[-1]]:
            path.append(after[path[-1]].pop())
            at = path.index(path[-1])
            loop, path = path[at:-1], path[: at + 1]
            faces += [[loop[0], loop[k], loop[k + 1]] for k in range(1, len(loop) - 1)]
    return faces
