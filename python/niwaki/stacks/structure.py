"""Structures as arrays, made from the values of models: the input of judges, files and pictures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki.errors import FileError
from niwaki.stacks.blocks import BOTTOM, SIDES, TOP

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Touch:
    """A contact of two bodies.

    Attributes
    ----------
    first, second : int
        Numbers of the bodies; -1 is the ground. The normal points from the first body to the second.
    points : array of shape (4, 3)
        Corners of the contact, metres.
    frame : array of shape (3, 3)
        The normal and two directions in the contact's plane, as rows.
    """

    first: int
    second: int
    points: Floats
    frame: Floats


@dataclass(frozen=True)
class Structure:
    """A structure: blocks, their contacts, and the conditions under which it should stand.

    Attributes
    ----------
    corners : array of shape (blocks, 8, 3)
        Corners in metres, z up; a block is the convex hull of its corners.
    touches : tuple of Touch
        The contacts.
    friction : float
        Coulomb's coefficient.
    downs : array of shape (directions, 3)
        The directions of gravity in which the structure should stand.
    prefixes : tuple of int
        The number of blocks at each step of construction at which the structure should stand.
    """

    corners: Floats
    touches: tuple[Touch, ...]
    friction: float
    downs: Floats
    prefixes: tuple[int, ...]

    @classmethod
    def of(cls, value: Any) -> Structure:
        """Make a structure from a sample of a result, or from the value of a model of stacks.

        Raises
        ------
        FileError
            A contact has vanished: its faces no longer overlap.
        """
        value = getattr(value, "value", value)
        corners = np.array([[list(point) for point in block] for block in value.blocks], dtype=np.float64)
        touches = tuple(
            Touch(
                int(touch.first),
                int(touch.second),
                _points(touch.points),
                _points((touch.normal, touch.along, touch.across)),
            )
            for touch in value.contacts
        )
        structure = cls(
            corners,
            touches,
            float(value.friction),
            _points(value.downs),
            tuple(int(count) for count in value.prefixes),
        )
        structure.check()
        return structure

    def check(self) -> None:
        """Refuse contacts without area, and blocks that are inside out."""
        for touch in self.touches:
            wide, deep = touch.points[1] - touch.points[0], touch.points[3] - touch.points[0]
            across, along = float(deep @ touch.frame[2]), float(wide @ touch.frame[1])
            if not (along > 0.0 and across > 0.0):
                raise FileError("contact-vanished", first=_name(touch.first), second=_name(touch.second))
        for number in range(len(self.corners)):
            if not self.solid(number)[0] > 0.0:
                raise FileError("block-inside-out", block=_name(number))
            if not self.is_convex(number):
                raise FileError("block-not-convex", block=_name(number))

    def __len__(self) -> int:
        return len(self.corners)

    def first(self, count: int) -> Structure:
        """Return the structure of the first blocks alone."""
        touches = tuple(touch for touch in self.touches if max(touch.first, touch.second) < count)
        return Structure(self.corners[:count], touches, self.friction, self.downs, (count,))

    def faces(self, number: int) -> NDArray[np.int64]:
        """Return a block's triangles, counter-clockwise from outside; a twisted side is cut at its outer diagonal."""
        corners = self.corners[number]
        triangles = [(a, b, c) for a, b, c, _ in (BOTTOM, TOP)] + [(a, c, d) for a, _, c, d in (BOTTOM, TOP)]
        for a, b, c, d in SIDES:
            p, q, r, s = corners[[a, b, c, d]]
            outer = np.linalg.det([q - p, r - p, s - p]) > 0.0
            triangles += [(a, b, d), (b, c, d)] if outer else [(a, b, c), (a, c, d)]
        return np.array(triangles, dtype=np.int64)

    def is_convex(self, number: int) -> bool:
        """Return whether all corners lie inside all faces of a block, up to a thousandth of its size."""
        corners = self.corners[number]
        p, q, r = corners[self.faces(number)].transpose(1, 0, 2)
        out = np.cross(q - p, r - p)
        out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-300)
        heights = np.einsum("fi,cfi->cf", out, corners[:, None, :] - p)
        return bool(heights.max() <= 1e-3 * float(np.ptp(corners, axis=0).max()))

    def solid(self, number: int) -> tuple[float, Floats]:
        """Return volume and centre of mass of a block."""
        corners = self.corners[number]
        middle = corners.mean(axis=0)
        p, q, r = (corners[self.faces(number)] - middle).transpose(1, 0, 2)
        parts = np.einsum("ij,ij->i", p, np.cross(q, r)) / 6.0
        volume = float(parts.sum())
        return volume, middle + 0.25 * (parts[:, None] * (p + q + r)).sum(axis=0) / volume

    def solids(self) -> tuple[Floats, Floats]:
        """Return volumes, of shape (blocks,), and centres of mass, of shape (blocks, 3)."""
        solids = [self.solid(number) for number in range(len(self))]
        return np.array([volume for volume, _ in solids]), np.array([centre for _, centre in solids])


def plain(corners: ArrayLike, touches: Any, friction: float, down: ArrayLike = (0.0, 0.0, -1.0)) -> Structure:
    """Make a structure from arrays: corners (blocks, 8, 3), and for each contact (first, second, points, frame)."""
    blocks = np.asarray(corners, dtype=np.float64)
    contacts = tuple(Touch(a, b, np.asarray(p, float), np.asarray(f, float)) for a, b, p, f in touches)
    structure = Structure(blocks, contacts, friction, np.asarray([down], dtype=np.float64), (len(blocks),))
    structure.check()
    return structure


def _points(points: Any) -> Floats:
    return np.array([list(point) for point in points], dtype=np.float64)


def _name(body: int) -> str:
    return "the ground" if body < 0 else f"block {body + 1}"
