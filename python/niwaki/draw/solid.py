"""A scene as a watertight solid for printing: the union of its shapes, by manifold3d (extra `print`).

Every shape is checked first; the error about a mesh that has holes or is inside out names the address of the part.
Parts that must not intersect only touch, and a print of such parts falls apart. So every shape is expanded along its
normals by `FUSE` of the scene's longest side before the union, far less than a printer resolves. Printers use
millimetres and have z up, so the solid is scaled, turned, and moved to positive coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.assembly import Assembly
from niwaki.draw.closed import closed
from niwaki.draw.closed import kernel as kernel
from niwaki.draw.far import is_far
from niwaki.draw.finite import finite, floats
from niwaki.draw.parts import joined
from niwaki.errors import FileError
from niwaki.errors.warned import warn

#: Details of the union below this share of its longest side are removed: slivers below the precision of a float.
SMALLEST = 1e-6

#: The expansion of each shape, as a share of the scene's longest side; 0.002 mm for a print of 100 mm.
FUSE = 2e-5

#: Millimetres in a scene unit by default: scenes are in metres.
METRE = 1000.0


class PrintWarning(UserWarning):
    """A solid that can be printed, but perhaps not as its author intends."""


@dataclass(frozen=True)
class Solid:
    """A closed surface ready to print.

    Attributes
    ----------
    vertices : (n, 3) float32
        Points in millimetres, z up, not negative.
    faces : (m, 3) int64
        Triangles, counter-clockwise seen from outside; each edge lies between exactly two triangles.
    volume : float
        The volume in cubic millimetres.
    pieces : int
        The number of separate bodies.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.int64]
    volume: float
    pieces: int


def union(scene: Assembly, scale: float = METRE, fuse: float | None = None) -> Solid:
    """Join all shapes of a scene to one solid.

    Parameters
    ----------
    scene
        The scene.
    scale
        Millimetres for each scene unit; 1000 when left out, because scenes are in metres.
    fuse
        The expansion of each shape, scene units; shapes closer than twice this distance are connected. The default is
        `FUSE` of the longest side, enough for shapes that touch.

    Raises
    ------
    FileError
        The extra `print` is not installed, or a part is not a solid.

    Warns
    -----
    PrintWarning
        The solid is in several pieces.
    """
    if not 0.0 < scale < float("inf"):
        raise FileError("setting", name="scale", found=scale, expected="a finite number above 0")
    longest = float(scene.size.max())
    for part in scene.parts:
        # The solid is moved to positive coordinates, so the extent matters, too.
        corners = np.array([shape.aabb() for shape in part.shapes], dtype=np.float64)
        with np.errstate(over="ignore"):
            floats(scale * corners, part.address, f"its coordinates at a scale of {scale:g}")
            floats(scale * longest, part.address, f"the scene's extent at a scale of {scale:g}")
    if fuse is not None and not 0.0 <= fuse < longest:
        expected = f"a number of scene units from 0 to less than the scene's longest side, {longest:.4g}"
        raise FileError("setting", name="fuse", found=fuse, expected=expected)
    tools = kernel()
    solids = _solids(scene, tools, FUSE * longest if fuse is None else fuse)
    joined = tools.Manifold.batch_boolean(solids, tools.OpType.Add)
    # (x, y, z) becomes (x, -z, y): the scene's y axis is up on the printer's bed.
    turned = joined.transform([[scale, 0, 0, 0], [0, 0, -scale, 0], [0, scale, 0, 0]])
    low, high = np.reshape(turned.bounding_box(), (2, 3))
    placed = turned.translate(-low).simplify(SMALLEST * float((high - low).max()))
    mesh = placed.to_mesh()
    vertices = np.maximum(np.asarray(mesh.vert_properties[:, :3], dtype=np.float32), 0.0)
    faces = np.asarray(mesh.tri_verts, dtype=np.int64)
    pieces = _pieces(vertices, faces)
    if pieces > 1:
        warn(
            f"the solid is in {pieces} pieces that do not touch, and a printer prints each piece alone; "
            "a larger `fuse` closes gaps",
            PrintWarning,
        )
    volume = float(finite(placed.volume(), "the solid", "its volume"))
    return Solid(finite(vertices, "the solid").astype(np.float32), faces, volume, pieces)


def _solids(scene: Assembly, tools: Any, distance: float) -> list[Any]:
    """Convert each shape to a solid of manifold3d; report all shapes that are not closed together."""
    solids, bad = [], []
    # Shapes are moved to the origin, because the library's tolerance grows with the distance from it.
    origin = scene.bounds[0] if is_far(scene.bounds) else np.zeros(3)
    for part in scene.parts:
        for number, shape in enumerate(part.shapes):
            if shape.steps():
                pieces = [mesh[1:] for mesh in closed(shape, part.address)]
                vertices, triangles, normals = joined([(v, f, n) for v, n, f in pieces])
            else:
                ((vertices, triangles, normals, _),) = _engine.meshes([[shape]])
            vertices, faces = _expand(vertices - origin, triangles, normals, distance)
            solid = tools.Manifold(tools.Mesh64(vertices, faces.astype(np.uint64)))
            reason = ""
            if (count := _open_edges(faces)) or solid.status() != tools.Error.NoError:
                reason = f"{count} open edges" if count else "edges between more than two triangles"
            elif solid.volume() <= 0.0:
                reason = "its triangles face inwards" if solid.volume() < 0.0 else "no volume"
            if reason:
                name = part.address if len(part.shapes) == 1 else f"{part.address}, shape {number + 1}"
                bad.append(f"{name} ({reason})")
            solids.append(solid)
    if bad:
        listed = "; ".join(bad[:4]) + (f"; and {len(bad) - 4} more" if len(bad) > 4 else "")
        raise FileError("not-a-solid", count=len(bad), total=len(solids), listed=listed)
    return solids


def _expand(
    vertices: NDArray[Any], faces: NDArray[Any], normals: NDArray[Any], distance: float
) -> tuple[NDArray[Any], NDArray[Any]]:
    """Merge vertices of a fine mesh that are at the same place, and move them outwards.

    A fine mesh has several vertices at a place where normals differ.
    """
    places, index = np.unique(vertices, axis=0, return_inverse=True)
    index = index.reshape(-1)
    outwards = np.zeros_like(places)
    np.add.at(outwards, index, normals)
    lengths = np.linalg.norm(outwards, axis=1, keepdims=True)
    corners = index[faces]
    a, b, c = corners.T
    triangles = corners[(a != b) & (b != c) & (c != a)]
    return places + distance * outwards / np.where(lengths > 0.0, lengths, 1.0), triangles


def _pieces(vertices: NDArray[Any], faces: NDArray[Any]) -> int:
    """Count the bodies of a closed surface; the walls of a hollow, which face inwards, do not count.

    Each vertex repeatedly takes the smallest label of its neighbours, and the label of that label, until no label
    changes.
    """
    label = np.arange(len(vertices))
    while True:
        smallest = label.copy()
        np.minimum.at(smallest, faces.reshape(-1), np.repeat(label[faces].min(axis=1), 3))
        smallest = smallest[smallest]
        if np.array_equal(smallest, label):
            break
        label = smallest
    a, b, c = (vertices[faces[:, k]].astype(np.float64) for k in range(3))
    volumes = np.bincount(label[faces[:, 0]], np.einsum("ij,ij->i", a, np.cross(b, c)))
    return int((volumes > 0.0).sum())


def _open_edges(faces: NDArray[Any]) -> int:
    """Count edges without an opposite edge."""
    a, b = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).T
    base = int(faces.max()) + 1
    return int(np.setxor1d(a * base + b, b * base + a).size // 2)
