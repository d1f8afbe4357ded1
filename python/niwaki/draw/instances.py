"""Instances: meshes that several parts share.

Two parts are equal if a scale, a rotation and a translation move the vertices of the first onto those of the second,
number by number. The tolerance is `TOLERANCE` of the part's extent, about the precision of a 32-bit float. So:

1. parts with different triangles, or with equal triangles in different pieces, are different;
2. parts with different inner measures (singular values of the centred vertices, as shares of the farthest vertex's
   distance) are different;
3. the scale is the ratio of these distances, and the best rotation is Kabsch's (1976, by the singular value
   decomposition); its largest residual decides.

Mirror images are different. Solids with equal points but different vertex numbers are different, too, for example boxes
of size (1, 2, 1) and (2, 1, 1). They are written twice, which only costs bytes.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.draw.parts import PartMesh

#: The largest distance between equal vertices, as a share of the part's extent.
TOLERANCE = 1e-6

Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True)
class Instance:
    """The place of a part.

    Attributes
    ----------
    mesh : int
        The number of the shared geometry.
    scale
        The factor of the geometry's own coordinates; it applies first.
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
        The first part with this geometry; its frame defines the geometry's own coordinates.
    """

    part: PartMesh

    def local(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert points of the scene to the geometry's own coordinates, (n, 3)."""
        return self.local_directions(points - self.part.pivot.origin)

    def local_directions(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert directions of the scene to the geometry's own coordinates, (n, 3)."""
        local: NDArray[np.float64] = directions @ self.part.pivot.axes
        return local


@dataclass
class _Bucket:
    """Geometries with equal triangles: their numbers and inner measures."""

    numbers: list[int] = field(default_factory=list)
    measures: list[NDArray[np.float64]] = field(default_factory=list)


def instances(parts: Sequence[PartMesh]) -> tuple[list[Geometry], list[Instance]]:
    """Return the different geometries of parts, and an instance with its place for each part."""
    geometries: list[Geometry] = []
    clouds: list[NDArray[np.float64]] = []
    placed: list[Instance] = []
    buckets: dict[bytes, _Bucket] = {}
    for part in parts:
        cloud = np.concatenate([piece.vertices for piece in part.pieces])
        measure = _measure(cloud)
        bucket = buckets.setdefault(_triangles(part), _Bucket())
        number, motion = -1, None
        if bucket.numbers:
            apart = np.abs(np.array(bucket.measures) - measure).max(axis=1)
            for k in np.nonzero(apart <= TOLERANCE)[0]:
                number = bucket.numbers[k]
                motion = similar(clouds[number], cloud)
                if motion is not None:
                    break
        if motion is None:
            number = len(geometries)
            geometries.append(Geometry(part))
            clouds.append(cloud)
            bucket.numbers.append(number)
            bucket.measures.append(measure)
            motion = 1.0, np.eye(3), np.zeros(3)
        scale, rotation, shift = motion
        pivot = geometries[number].part.pivot
        placed.append(Instance(number, scale, rotation @ pivot.axes, shift + scale * rotation @ pivot.origin))
    return geometries, placed


def similar(
    first: NDArray[Any], second: NDArray[Any]
) -> tuple[float, NDArray[np.float64], NDArray[np.float64]] | None:
    """Find the scale, rotation and translation that move `first` to `second`, both (n, 3); None if there are none."""
    here, there = first.mean(axis=0), second.mean(axis=0)
    scale = _reach(second - there) / max(_reach(first - here), np.finfo(float).tiny)
    if abs(scale - 1.0) <= TOLERANCE:
        scale = 1.0
    left, _, right = np.linalg.svd((second - there).T @ (first - here))
    # A reflection has determinant -1: the least important axis is reversed, so that the result is a rotation.
    turn = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(left @ right)))])
    rotation = left @ turn @ right
    shift = there - scale * rotation @ here
    residual = np.abs(scale * first @ rotation.T + shift - second).max()
    return (scale, rotation, shift) if residual <= TOLERANCE * _extent(second) else None


def quaternion(rotation: NDArray[np.float64]) -> Quaternion:
    """Convert a rotation to a unit quaternion (x, y, z, w), w not negative (Shepperd 1978: largest component first)."""
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
    """Hash a part's triangles, piece by piece."""
    digest = hashlib.sha256()
    for piece in part.pieces:
        digest.update(f"{len(piece.vertices)} {len(piece.faces)};".encode())
        digest.update(piece.faces.tobytes())
    return digest.digest()


def _measure(cloud: NDArray[np.float64]) -> NDArray[np.float64]:
    """Measure the spread along the principal axes, as shares of the reach, (3,); motions and scales keep it."""
    centred = cloud - cloud.mean(axis=0)
    spread = np.linalg.svd(centred, compute_uv=False) / np.sqrt(len(cloud))
    return np.array([*spread, *np.zeros(3 - len(spread))]) / max(_reach(centred), np.finfo(float).tiny)


def _reach(centred: NDArray[np.float64]) -> float:
    """Return the distance of the farthest vertex from the middle."""
    return float(np.linalg.norm(centred, axis=1).max())


def _extent(cloud: NDArray[np.float64]) -> float:
    return float(np.linalg.norm(np.ptp(cloud, axis=0)))
