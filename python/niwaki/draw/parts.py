"""The parts of a scene as meshes to write: for each part, one mesh for each of its paints.

Tones that the palette varies from part to part are brought together here (to steps of `TONE_STEP`, too small
to see), so that a file has a few dozen materials and not one for each part; colours that a model names stay exact.
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

#: Steps of a tone of the palette, sRGB in [0, 1].
TONE_STEP = 1 / 32


class Pivot(NamedTuple):
    """The frame of a shape in the scene: where it is, and the axes about which a person would turn it.

    Attributes
    ----------
    origin : (3,) float64
        Scene units.
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
        How it looks.
    vertices, normals : (n, 3) float64
        Scene units; unit length.
    faces : (m, 3) uint32
        Counter-clockwise seen from outside.
    """

    paint: Paint
    vertices: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.uint32]


@dataclass(frozen=True)
class PartMesh:
    """A part's address, its pieces, and its own frame, which is that of its first shape."""

    address: str
    pieces: tuple[Piece, ...]
    pivot: Pivot


def part_meshes(scene: Assembly) -> list[PartMesh]:
    """The fine meshes of every part that has a shape, in the order of the addresses."""
    groups: dict[tuple[int, Paint], list[Shape]] = {}
    for number, (part, part_paints) in enumerate(zip(scene.parts, paints(scene), strict=True)):
        for shape, paint in zip(part.shapes, part_paints, strict=True):
            shown = paint if shape.color is not None else _stepped(paint)
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


def _stepped(paint: Paint) -> Paint:
    red, green, blue = (round(round(c / TONE_STEP) * TONE_STEP, 6) for c in paint.color)
    return replace(paint, color=(red, green, blue))
