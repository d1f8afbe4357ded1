"""Meshes of the parts of a scene: for each part, a mesh for each of its paints.

The palette varies tones from part to part. Here they are rounded to steps of `TONE_STEP`, too small to see, so that a
file has a few dozen materials rather than one for each part. Colours that a model sets stay exact.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki._engine import Shape
from niwaki.draw.assembly import Assembly
from niwaki.draw.finite import floats
from niwaki.draw.palette import Paint, paints

#: The step of rounded tones, sRGB in [0, 1].
TONE_STEP = 1 / 32


class Pivot(NamedTuple):
    """The frame of a shape in the scene: its origin and its natural axes of rotation.

    Attributes
    ----------
    origin : (3,) float64
        The origin, scene units.
    axes : (3, 3) float64
        Unit directions x, y and z as columns, right-handed.
    """

    origin: NDArray[np.float64]
    axes: NDArray[np.float64]


@dataclass(frozen=True)
class Piece:
    """The shapes of one paint in a part, merged.

    Attributes
    ----------
    paint
        The look.
    vertices, normals : (n, 3) float64
        Points in scene units; vectors of unit length.
    faces : (m, 3) uint32
        Counter-clockwise seen from outside.
    """

    paint: Paint
    vertices: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.uint32]


@dataclass(frozen=True)
class PartMesh:
    """The mesh of a part: its address, its pieces, and the frame of its first shape."""

    address: str
    pieces: tuple[Piece, ...]
    pivot: Pivot


def part_meshes(scene: Assembly) -> list[PartMesh]:
    """Return the fine meshes of all parts with shapes, in the order of the addresses."""
    groups: dict[tuple[int, Paint], list[Shape]] = {}
    for number, (part, part_paints) in enumerate(zip(scene.parts, paints(scene), strict=True)):
        for shape, paint in zip(part.shapes, part_paints, strict=True):
            shown = paint if shape.color is not None else _round_tone(paint)
            groups.setdefault((number, shown), []).append(shape)
    out: dict[int, PartMesh] = {}
    meshes = _engine.meshes(list(groups.values()))
    for (number, paint), (vertices, faces, normals, frame) in zip(groups, meshes, strict=True):
        address = scene.parts[number].address
        # Files keep 32 bits of each number.
        floats(vertices, address)
        floats(normals, address, "its normals")
        part_mesh = out.setdefault(number, PartMesh(address, (), Pivot(*frame)))
        out[number] = replace(part_mesh, pieces=(*part_mesh.pieces, Piece(paint, vertices, normals, faces)))
    return list(out.values())


def _round_tone(paint: Paint) -> Paint:
    red, green, blue = (round(round(c / TONE_STEP) * TONE_STEP, 6) for c in paint.color)
    return replace(paint, color=(red, green, blue))
