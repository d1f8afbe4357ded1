"""The parts of a scene as meshes to write: for each part, one mesh for each of its paints.

Tones that the palette varies from part to part are brought together here (to steps of `TONE_STEP`, too small
to see), so that a file has a few dozen materials and not one for each part; colours that a model names stay exact.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki._engine import Shape
from niwaki.draw.assembly import Assembly
from niwaki.draw.finite import floats
from niwaki.draw.palette import Paint, paints

#: Steps of a tone of the palette, sRGB in [0, 1].
TONE_STEP = 1 / 32


@dataclass(frozen=True)
class Piece:
    """The shapes of one paint in a part, merged.

    Attributes
    ----------
    paint
        How it looks.
    vertices, normals : (n, 3) float64
        Scene units; unit length.
    faces : (m, 3) int64
        Counter-clockwise seen from outside.
    """

    paint: Paint
    vertices: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.int64]


@dataclass(frozen=True)
class PartMesh:
    """A part's address, its pieces, and its first shape, whose frame is the part's own."""

    address: str
    pieces: tuple[Piece, ...]
    first: Shape


def part_meshes(scene: Assembly) -> list[PartMesh]:
    """The fine meshes of every part that has a shape, in the order of the addresses."""
    out = []
    for part, part_paints in zip(scene.parts, paints(scene), strict=True):
        groups: dict[Paint, list[tuple[NDArray[Any], NDArray[Any], NDArray[Any]]]] = {}
        for shape, paint in zip(part.shapes, part_paints, strict=True):
            shown = paint if shape.color is not None else _stepped(paint)
            vertices, faces, normals = _engine.fine_mesh(shape)
            # Files keep 32 bits of each number.
            floats(vertices, part.address)
            floats(normals, part.address, "its normals")
            groups.setdefault(shown, []).append((vertices, faces, normals))
        if groups:
            pieces = tuple(_merged(paint, group) for paint, group in groups.items())
            out.append(PartMesh(part.address, pieces, part.shapes[0]))
    return out


def _stepped(paint: Paint) -> Paint:
    red, green, blue = (round(round(c / TONE_STEP) * TONE_STEP, 6) for c in paint.color)
    return replace(paint, color=(red, green, blue))


def _merged(paint: Paint, meshes: list[tuple[NDArray[Any], NDArray[Any], NDArray[Any]]]) -> Piece:
    starts = np.cumsum([0, *(len(vertices) for vertices, _, _ in meshes)])
    faces = [mesh[1] + start for mesh, start in zip(meshes, starts, strict=False)]
    vertices, normals = (np.concatenate([mesh[k] for mesh in meshes]) for k in (0, 2))
    return Piece(paint, vertices, normals, np.concatenate(faces))
