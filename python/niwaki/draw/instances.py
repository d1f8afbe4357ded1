"""Which parts are one mesh in several places.

Two parts are equal when one scale, a rotation and a translation take the vertices of one onto those of the other,
number by number, within `TOLERANCE` of the part's extent (about what a 32-bit float keeps). So:

1. parts with other triangles, or with the same ones in other pieces, are different;
2. parts with other inner measures (singular values of the centred vertices, as shares of the farthest vertex's
   distance) are different;
3. the scale is the ratio of those distances, and the best rotation is Kabsch's (1976, through the singular value
   decomposition); its largest residual decides.

Mirror images are different. So are solids that agree as sets of points but number their vertices differently, such as a
box of size (1, 2, 1) and one of size (2, 1, 1): they are written twice, which costs bytes and nothing else.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.draw.parts import PartMesh

#: Largest distance between vertices that count as one, as a share of the part's extent.
TOLERANCE = 1e-6

Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True)
class Instance:
    """The place of a part.

    Attributes
    ----------
    mesh : int
        Number of the geometry it shares.
    scale
        Factor on the geometry's own coordinates, first.
    rotation : (3, 3) float64
        From the geometry's own directions to the scene's.
    translation : (3,) float64
        Scene units, after the rotation.
    """

    mesh: int
    scale: float
    rotation: NDArray[np.float64]
    translation: NDArray[np.float64]


@dataclass(frozen=True)
class Geometry:
    """A mesh that parts share.

    Attributes
    ----------
    part
        The first part that has it; its frame is that of the geometry's own coordinates.
    """

    part: PartMesh

    def local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of the scene in the geometry's own coordinates, (n, 3)."""
        return self.local_directions(points - self.part.pivot.origin)

    def local_directions(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Directions of the scene in the geometry's own coordinates, (n, 3)."""
        found: NDArray[np.float64] = directions @ self.part.pivot.axes
        return found


@dataclass
class _Bucket:
    """Geometries with equal triangles: their numbers and inner measures."""

    numbers: list[int] = field(default_factory=list)
    measures: list[NDArray[np.float64]] = field(default_factory=list)


def instances(parts: Sequence[PartMesh]) -> tuple[list[Geometry], list[Instance]]:
    """The different geometries of some parts, and an instance with its place for each part."""
    geometries: list[Geometry] = []
    clouds: list[NDArray[np.float64]] = []
    placed: list[Instance] = []
    buckets: dict[bytes, _Bucket] = {}
    for part in parts:
        cloud = np.concatenate([piece.vertices for piece in part.pieces])
        measure = _measure(cloud)
        bucket = buckets.setdefault(_triangles(part), _Bucket())
        number, found = -1, None
        if bucket.numbers:
            apart = np.abs(np.array(bucket.measures) - measure).max(axis=1)
            for k in np.nonzero(apart <= TOLERANCE)[0]:
                number = bucket.numbers[k]
                found = similar(clouds[number], cloud)
                if found is not None:
                    break
        if found is None:
            number = len(geometries)
            geometries.append(Geometry(part))
            clouds.append(cloud)
            bucket.numbers.append(number)
            bucket.measures.append(measure)
            found = 1.0, np.eye(3), np.zeros(3)
        scale, rotation, shift = found
        own = geometries[number].part.pivot
        placed.append(Instance(number, scale, rotation @ own.axes, shift + scale * rotation @ own.origin))
    return geometries, placed


def similar(
    first: NDArray[Any], second: NDArray[Any]
) -> tuple[float, NDArray[np.float64], NDArray[np.float64]] | None:
    """The scale, rotation and translation that take `first` to `second`, both (n, 3); None where there are none."""
    here, there = first.mean(axis=0), second.mean(axis=0)
    scale = _reach(second - there) / max(_reach(first - here), np.finfo(float).tiny)
    if abs(scale - 1.0) <= TOLERANCE:
        scale = 1.0
    left, _, right = np.linalg.svd((second - there).T @ (first - here))
    # A reflection has determinant -1: turn the least important axis, so that what comes out is a rotation.
    turn = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(left @ right)))])
    rotation = left @ turn @ right
    shift = there - scale * rotation @ here
    residual = np.abs(scale * first @ rotation.T + shift - second).max()
    return (scale, rotation, shift) if residual <= TOLERANCE * _extent(second) else None


def quaternion(rotation: NDArray[np.float64]) -> Quaternion:
    """A rotation as a unit quaternion (x, y, z, w), w not negative (Shepperd 1978: the largest component first)."""
    m = rotation
    trace = m[0, 0] + m[1, 1] + m[2, 2]
    k = int(np.argmax([m[0, 0], m[1, 1], m[2, 2], trace]))
    q = np.empty(4)
    if k == 3:
        q[:3] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]
        q[3] = 1.0 + trace
    else:
        i, j = (k + 1) % 3, (k + 2) % 3
        q[k] = 1.0 + 2.0 * m[k, k] - trace
        q[i], q[j] = m[k, i] + m[i, k], m[k, j] + m[j, k]
        q[3] = m[j, i] - m[i, j]
    q /= np.linalg.norm(q)
    x, y, z, w = (float(c) for c in (-q if q[3] < 0 else q))
    return (x, y, z, w)


def _triangles(part: PartMesh) -> bytes:
    """A digest of a part's triangles, piece by piece."""
    digest = hashlib.sha256()
    for piece in part.pieces:
        digest.update(f"{len(piece.vertices)} {len(piece.faces)};".encode())
        digest.update(piece.faces.tobytes())
    return digest.digest()


def _measure(cloud: NDArray[np.float64]) -> NDArray[np.float64]:
    """What no motion and no scale changes: spread along the principal axes, as shares of the reach, (3,)."""
    centred = cloud - cloud.mean(axis=0)
    spread = np.linalg.svd(centred, compute_uv=False) / np.sqrt(len(cloud))
    return np.array([*spread, *np.zeros(3 - len(spread))]) / max(_reach(centred), np.finfo(float).tiny)


def _reach(centred: NDArray[np.float64]) -> float:
    """The distance of the farthest vertex from the middle."""
    return float(np.linalg.norm(centred, axis=1).max())


def _extent(cloud: NDArray[np.float64]) -> float:
    return float(np.linalg.norm(np.ptp(cloud, axis=0)))
