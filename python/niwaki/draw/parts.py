"""Meshes of the parts of a scene: for each part, a mesh for each of its paints; in files a closed one (`closed.py`).

The palette varies tones from part to part. Here they are rounded to steps of `TONE_STEP`, too small to see, so that a
file has a few dozen materials rather than one for each part. Colours that a model sets stay exact.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki._engine import Shape
from niwaki.draw.assembly import Assembly
from niwaki.draw.closed import closed as closed_mesh
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


def part_meshes(scene: Assembly, closed: bool = True) -> list[PartMesh]:
    """Return the fine meshes of all parts with shapes, in the order of the addresses.

    Parameters
    ----------
    scene
        The scene.
    closed
        True for files: the mesh of a cut solid is closed corner to corner. False for pictures, which need no library.

    Raises
    ------
    FileError
        A closed mesh needs a library that is not installed.
    """
    scene = coated(scene)
    groups: dict[tuple[int, Paint], list[Shape]] = {}
    for number, (part, part_paints) in enumerate(zip(scene.parts, paints(scene), strict=True)):
        for shape, paint in zip(part.shapes, part_paints, strict=True):
            shown = paint if shape.color is not None else _round_tone(paint)
            groups.setdefault((number, shown), []).append(shape)
    out: dict[int, PartMesh] = {}
    meshes = _engine.meshes(list(groups.values()))
    for (number, paint), (vertices, faces, normals, frame) in zip(groups, meshes, strict=True):
        address = scene.parts[number].address
        shapes = groups[number, paint]
        if closed and any(shape.steps() for shape in shapes):
            vertices, faces, normals = _closed(shapes, address)
        # Files keep 32 bits of each number.
        floats(vertices, address)
        floats(normals, address, "its normals")
        part_mesh = out.setdefault(number, PartMesh(address, (), Pivot(*frame)))
        out[number] = replace(part_mesh, pieces=(*part_mesh.pieces, Piece(paint, vertices, normals, faces)))
    return list(out.values())


def coated(scene: Assembly) -> Assembly:
    """Return a scene whose shapes have one look each: a cut solid whose faces have several becomes its coats."""
    return Assembly(
        (
            part.address,
            [coat for shape in part.shapes for coat in (shape.coats() if shape.steps() else [shape])],
        )
        for part in scene.parts
    )


def _closed(shapes: list[Shape], address: str) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Join the meshes of shapes, closed ones of cut solids: vertices, faces and normals."""
    meshes: list[tuple[NDArray[Any], NDArray[Any], NDArray[Any]]] = []
    for shape in shapes:
        if shape.steps():
            shown = set(shape.shown())
            pieces = [piece for piece in closed_mesh(shape, address) if piece.leaf in shown]
            meshes += [(piece.vertices, piece.faces, piece.normals) for piece in pieces]
        else:
            meshes += [mesh[:3] for mesh in _engine.meshes([[shape]])]
    return joined(meshes)


def joined(
    meshes: list[tuple[NDArray[Any], NDArray[Any], NDArray[Any]]],
) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    """Join meshes (vertices, faces, normals) to one mesh."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _, _ in meshes)])
    faces = [faces + np.uint32(start) for (_, faces, _), start in zip(meshes, starts, strict=False)]
    return (
        np.concatenate([v for v, _, _ in meshes]),
        np.concatenate(faces),
        np.concatenate([n for _, _, n in meshes]),
    )


def _round_tone(paint: Paint) -> Paint:
    red, green, blue = (round(round(c / TONE_STEP) * TONE_STEP, 6) for c in paint.color)
    return replace(paint, color=(red, green, blue))
