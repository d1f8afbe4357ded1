"""Assemblies: the parts that a model emitted, each named by the address of its `emit`.

An assembly is a multiset, sorted by address, so that two runs with equal parts in different order give equal files.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki._engine import Shape


class Volume(Protocol):
    """A target as a picture needs it: a mesh that is drawn as a ghost."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Low and high corner of the mesh, (2, 3)."""
        ...


@dataclass(frozen=True)
class Part:
    """The shapes of one `emit`.

    Attributes
    ----------
    address : str
        The readable address of the `emit`.
    shapes : tuple of Shape
        The shapes, in the order of the call.
    """

    address: str
    shapes: tuple[Shape, ...]


class Assembly:
    """Parts in the order of their addresses: a scene as drawing and writing need it.

    Parameters
    ----------
    parts
        Parts, or pairs of an address and its shapes.

    Attributes
    ----------
    parts : tuple of Part
    """

    def __init__(self, parts: Iterable[Part | tuple[str, Iterable[Shape]]]) -> None:
        listed = [part if isinstance(part, Part) else Part(part[0], tuple(part[1])) for part in parts]
        self.parts: tuple[Part, ...] = tuple(sorted(listed, key=lambda part: _natural(part.address)))

    def __len__(self) -> int:
        """Count the parts."""
        return len(self.parts)

    def __iter__(self) -> Iterator[Part]:
        """Go through the parts in the order of their addresses."""
        return iter(self.parts)

    def __repr__(self) -> str:
        """Count parts and shapes."""
        count = sum(len(part.shapes) for part in self.parts)
        return f"<{type(self).__name__}: {len(self)} parts, {count} shapes>"

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Low and high corner of the smallest box around all shapes, (2, 3); zeros for an empty scene."""
        boxes = np.array([shape.aabb() for part in self.parts for shape in part.shapes], dtype=np.float64)
        if len(boxes) == 0:
            return np.zeros((2, 3))
        return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])

    @property
    def size(self) -> NDArray[np.float64]:
        """Extent of the scene along x, y and z, (3,)."""
        low, high = self.bounds
        return np.asarray(high - low)

    def merged(self, fine: bool = True) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Collect all shapes in a single mesh, without joining them.

        Parameters
        ----------
        fine
            True for the mesh of pictures, False for the light mesh of scores.

        Returns
        -------
        vertices : (n, 3) float64
        faces : (m, 3) int64
        """
        shapes = [shape for part in self.parts for shape in part.shapes]
        ((vertices, faces, _, _),) = _engine.meshes([shapes], fine=fine)
        return vertices, faces.astype(np.int64)


def _natural(address: str) -> tuple[tuple[str, int], ...]:
    """Make a key that sorts `wing[10]` after `wing[9]`."""
    return tuple((text, int(digits or -1)) for text, digits in re.findall(r"([^0-9]*)([0-9]*)", address))
