"""Vectors of two to four numbers, for points and directions; `+ - *` and `/` work as in geometry books.

Coordinates are right-handed, y is up, and angles are in radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

__all__ = [
    "Rotation",
    "Vec",
    "cross",
    "distance",
    "dot",
    "norm",
    "normalize",
    "rotate",
    "rotation",
    "vec",
]


@dataclass(frozen=True)
class Vec:
    """A vector, made by `vec(x, y)`, `vec(x, y, z)` or `vec(x, y, z, w)`."""

    parts: tuple[float, ...]

    @property
    def x(self) -> float:
        """The first part."""
        return self.parts[0]

    @property
    def y(self) -> float:
        """The second part."""
        return self.parts[1]

    @property
    def z(self) -> float:
        """The third part."""
        return self._part(2, "z")

    @property
    def w(self) -> float:
        """The fourth part."""
        return self._part(3, "w")

    def _part(self, index: int, name: str) -> float:
        if index >= len(self.parts):
            raise AttributeError(f"a vector of {len(self.parts)} numbers has no `{name}`")
        return self.parts[index]

    def __len__(self) -> int:
        return len(self.parts)

    def __iter__(self) -> Iterator[float]:
        return iter(self.parts)

    def __getitem__(self, index: int) -> float:
        return self.parts[index]

    def __add__(self, other: Vec) -> Vec:
        return Vec(tuple(a + b for a, b in zip(self.parts, _same_length(self, other), strict=True)))

    def __sub__(self, other: Vec) -> Vec:
        return Vec(tuple(a - b for a, b in zip(self.parts, _same_length(self, other), strict=True)))

    def __mul__(self, factor: float) -> Vec:
        return Vec(tuple(a * _number(factor) for a in self.parts))

    __rmul__ = __mul__

    def __truediv__(self, divisor: float) -> Vec:
        return Vec(tuple(a / _number(divisor) for a in self.parts))

    def __neg__(self) -> Vec:
        return Vec(tuple(-a for a in self.parts))

    def __pos__(self) -> Vec:
        return self

    def __repr__(self) -> str:
        return f"vec({', '.join(map(repr, self.parts))})"


VecLike = Vec | Sequence[float]


class Rotation(tuple[tuple[float, ...], ...]):
    """A rotation of space, a matrix of three rows; `rotation * vector` turns, `rotation * rotation` composes.

    `rotation(axis, angle)` makes a rotation. In a product, the right-hand rotation turns first.
    """

    __slots__ = ()

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Vec):
            return Vec(tuple(_sum(a * b for a, b in zip(row, _three(other), strict=True)) for row in self))
        if isinstance(other, Rotation):
            columns = list(zip(*other, strict=True))
            return Rotation(
                tuple(_sum(a * b for a, b in zip(row, column, strict=True)) for column in columns)
                for row in self
            )
        raise TypeError(f"a rotation turns a vector or another rotation, not {other!r}")

    __rmul__ = __add__ = __radd__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"rotation{[list(row) for row in self]!r}"


def _three(v: Vec) -> tuple[float, ...]:
    if len(v) != 3:
        raise TypeError(f"a rotation turns vectors of 3 numbers, found {len(v)}")
    return v.parts


def _sum(terms: Iterable[float]) -> float:
    """Add from left to right from 0, as the engine does; `sum` compensates for rounding from Python 3.12 on."""
    total = 0.0
    for term in terms:
        total = total + term
    return total


def _number(value: object) -> float:
    if not isinstance(value, (int, float)):
        raise TypeError(f"a vector is scaled by a number, not by {value!r}")
    return value


def _same_length(left: Vec, right: object) -> tuple[float, ...]:
    if not isinstance(right, Vec) or len(right) != len(left):
        raise TypeError(f"{left!r} and {right!r} are not vectors of one length")
    return right.parts


def _vec(value: VecLike) -> Vec:
    return value if isinstance(value, Vec) else Vec(tuple(float(part) for part in value))


def vec(x: float, y: float, z: float | None = None, w: float | None = None) -> Vec:
    """Make a vector of two, three or four numbers.

    Parameters
    ----------
    x, y, z, w
        The parts; leave out `w`, or `z` and `w`, for a shorter vector.
    """
    return Vec(tuple(float(part) for part in (x, y, z, w) if part is not None))


def dot(a: VecLike, b: VecLike) -> float:
    """Return the scalar product of two vectors of the same length."""
    a, b = _vec(a), _vec(b)
    total = 0.0
    for left, right in zip(a.parts, _same_length(a, b), strict=True):
        total += left * right
    return total


def cross(a: VecLike, b: VecLike) -> Vec:
    """Return the right-handed vector product of two vectors of three numbers."""
    ax, ay, az = _vec(a).parts
    bx, by, bz = _vec(b).parts
    return Vec((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))


def norm(v: VecLike) -> float:
    """Return the length of a vector."""
    return math.sqrt(dot(v, v))


def normalize(v: VecLike) -> Vec:
    """Return the vector of length one in the same direction."""
    return _vec(v) / norm(v)


def distance(a: VecLike, b: VecLike) -> float:
    """Return the distance between two points."""
    return norm(_vec(a) - _vec(b))


def rotation(axis: VecLike, angle: float) -> Rotation:
    """Return the right-handed rotation by `angle` radians about `axis`; `rotation * vector` turns a vector."""
    x, y, z = normalize(axis).parts
    c, s = math.cos(angle), math.sin(angle)
    t = 1.0 - c
    return Rotation(
        (
            (t * x * x + c, t * x * y - s * z, t * x * z + s * y),
            (t * x * y + s * z, t * y * y + c, t * y * z - s * x),
            (t * x * z - s * y, t * y * z + s * x, t * z * z + c),
        )
    )


def rotate(v: VecLike, axis: VecLike, angle: float) -> Vec:
    """Return the vector `v`, turned by `angle` radians about `axis`, right-handed."""
    return Vec(tuple(dot(row, v) for row in rotation(axis, angle)))
