"""A scene as a mesh for the page: a single mesh with the number of the part for each triangle.

The payload of a frame, for n vertices and m triangles, little-endian:

    positions (n, 3) float32 | normals (n, 3) float32, only if fine | colours (n, 4) uint8, sRGB
    corners (m, 3) uint32 | parts (m,) uint32 | metalness and roughness (n, 2) uint8, of 255

The light mesh is the mesh of scores; it has no normals, and the page shows flat faces.
"""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.palette import Paint, paints
from niwaki.draw.parts import part_meshes
from niwaki.draw.scene import Scene
from niwaki.studio.messages import Shape

GHOST = Paint("ghost", (0.36, 0.55, 0.80), 0.0)

#: Part, paint, vertices, normals, faces.
Piece = tuple[int, Paint, NDArray[Any], NDArray[Any] | None, NDArray[Any]]


def shape(scene: Scene, detail: Literal["light", "fine"], **header: Any) -> tuple[Shape, bytes]:
    """Return the header and the payload of a scene."""
    pieces = _fine(scene) if detail == "fine" else _light(scene)
    return _packed([part.address for part in scene.parts], pieces, detail=detail, **header)


def ghost(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    bounds: NDArray[np.float64],
    pivot: tuple[float, float, float],
    **header: Any,
) -> tuple[Shape, bytes]:
    """Return the header and the payload of a target or an obstacle."""
    shape, data = _packed([], [(0, GHOST, vertices, None, faces)], pivot=pivot, **header)
    low, high = bounds.tolist()
    shape.low, shape.high = tuple(low), tuple(high)
    return shape, data


def _fine(scene: Scene) -> list[Piece]:
    numbers = {part.address: number for number, part in enumerate(scene.parts)}
    return [
        (numbers[part.address], piece.paint, piece.vertices, piece.normals, piece.faces)
        for part in part_meshes(scene, closed=False)
        for piece in part.pieces
    ]


def _light(scene: Scene) -> list[Piece]:
    meshes = iter(_engine.meshes([[shape] for part in scene.parts for shape in part.shapes], fine=False))
    return [
        (number, paint, vertices, None, faces)
        for number, part_paints in enumerate(paints(scene))
        for paint, (vertices, faces, *_) in zip(part_paints, meshes, strict=False)
    ]


def _packed(parts: list[str], pieces: list[Piece], **header: Any) -> tuple[Shape, bytes]:
    """Pack pieces one after the other."""
    counts = [len(vertices) for _, _, vertices, _, _ in pieces]
    starts = np.cumsum([0, *counts])
    points = _joined([vertices for _, _, vertices, _, _ in pieces], 3, "<f4")
    faces = _joined([f + start for (_, _, _, _, f), start in zip(pieces, starts, strict=False)], 3, "<u4")
    colors = _tiled([(*paint.color, 1.0) for _, paint, *_ in pieces], counts, 4)
    finishes = _tiled([(paint.metalness, paint.roughness) for _, paint, *_ in pieces], counts, 2)
    owners = np.repeat([p for p, *_ in pieces], [len(f) for *_, f in pieces]).astype("<u4")
    arrays = [points, colors, faces, owners, finishes]
    normals = [directions for _, _, _, directions, _ in pieces if directions is not None]
    if normals:
        arrays.insert(1, _joined(normals, 3, "<f4"))
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(3), np.zeros(3))
    shape = Shape(
        vertices=len(points),
        triangles=len(faces),
        parts=parts,
        low=tuple(low.tolist()),
        high=tuple(high.tolist()),
        **header,
    )
    return shape, b"".join(array.tobytes() for array in arrays)


def _joined(arrays: list[NDArray[Any]], width: int, kind: str) -> NDArray[Any]:
    return np.concatenate([np.zeros((0, width)), *arrays]).astype(kind)


def _tiled(shares: list[tuple[float, ...]], counts: list[int], width: int) -> NDArray[np.uint8]:
    """Convert shares in [0, 1] to bytes, and repeat each piece's row for each of its vertices."""
    rows = np.clip(np.array(shares).reshape(len(shares), width), 0.0, 1.0)
    return np.repeat(np.round(255.0 * rows).astype(np.uint8), counts, axis=0)
