"""Meshes of what a generator returns: objects of libraries, arrays, bytes and files, as vertices and faces.

| what is returned | how it is read |
| --- | --- |
| `None`, a mesh without triangles | the empty scene |
| a mesh of trimesh, or any object with `vertices` and `faces` | its arrays |
| a scene of trimesh | all its meshes, in their places |
| a `Manifold` of manifold3d | `to_mesh()` |
| a shape of build123d or CadQuery, or any object with `tessellate` | its triangles, within 1/500 of its size |
| `(vertices, faces)`; faces of three or four corners | these arrays |
| `bytes` | GLB, glTF, or another format by its first bytes |
| a path | the file |
| a scene or shapes of Niwaki | their meshes |
| a list of these | all of them together |
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.assembly import Assembly
from niwaki.fitting.commands import read
from niwaki.targets import reading
from niwaki.targets.pieces import joined

Arrays = tuple[NDArray[np.float64], NDArray[np.int64]]

#: Distance of a curved surface from its triangles, as a share of its size; and the angle between two, radians.
TOLERANCE, ANGLE = 1 / 500, 0.3

#: A solid whose volume is a smaller share of its box is flat.
FLAT = 1e-6

EXPECTED = (
    "a mesh: an object with `vertices` and `faces`, with `to_mesh` or with `tessellate`, a pair of arrays, the bytes "
    "or the path of a mesh file, or a list of these"
)


class NotAMesh(ValueError):
    """A generator returned something that is no mesh."""


def mesh_of(value: Any) -> Arrays:
    """Return the mesh of what a generator returned: vertices (n, 3) and faces (m, 3); empty arrays for an empty mesh.

    Raises
    ------
    NotAMesh
        It is no mesh, a coordinate is not finite, or a face has a corner that does not exist.
    """
    return joined(list(_meshes(value, 0)))


def defects(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> list[str]:
    """Return what is wrong with a mesh that is scored all the same: "open", "inverted", "flat".

    Edges of a closed mesh lie between two triangles that run along them in opposite directions. Corners at the same
    place count as one, because files of some formats repeat them.
    """
    if not len(faces):
        return []
    _, places = np.unique(vertices, axis=0, return_inverse=True)
    corners = places.reshape(-1)[faces]
    corners = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    forward, backward = edges[:, 0] * len(vertices) + edges[:, 1], edges[:, 1] * len(vertices) + edges[:, 0]
    is_closed = np.array_equal(np.sort(forward), np.sort(backward))
    used = vertices[faces.ravel()]
    size = used.max(axis=0) - used.min(axis=0)
    a, b, c = (vertices[faces[:, k]] - used.min(axis=0) for k in range(3))
    volume = float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0
    is_flat = abs(volume) <= FLAT * float(size.max()) ** 3
    if not is_closed:
        return ["open"]
    return ["flat"] if is_flat else ["inverted"] if volume < 0 else []


def _meshes(value: Any, depth: int) -> list[Arrays]:
    if value is None:
        return []
    if isinstance(value, str | PathLike):
        return [_file(Path(fspath(value)))]
    if isinstance(value, bytes | bytearray | memoryview):
        return [_bytes(bytes(value))]
    if isinstance(value, Assembly):
        return _shapes([shape for part in value.parts for shape in part.shapes])
    if isinstance(value, _engine.Shape):
        return _shapes([value])
    if isinstance(value, tuple) and len(value) == 2 and _is_rows(value[0]) and _is_rows(value[1]):
        return [_arrays(*value)]
    if isinstance(value, list | tuple):
        if depth > 8:
            raise NotAMesh("it returned lists within lists: write one list of meshes")
        return [mesh for entry in value for mesh in _meshes(entry, depth + 1)]
    for reader in (_of_faces, _of_scene, _of_manifold, _of_kernel):
        mesh = reader(value)
        if mesh is not None:
            return mesh
    raise NotAMesh(f"it returned {_shown(value)}, and not {EXPECTED}")


def _of_faces(value: Any) -> list[Arrays] | None:
    """Read an object with arrays of vertices and faces, which are no methods."""
    vertices, faces = getattr(value, "vertices", None), getattr(value, "faces", None)
    if vertices is None or faces is None or callable(vertices) or callable(faces):
        return None
    return [_arrays(vertices, faces)]


def _of_scene(value: Any) -> list[Arrays] | None:
    """Read a scene of trimesh."""
    if not hasattr(value, "geometry") or not hasattr(value, "dump"):
        return None
    return [mesh for entry in value.dump() for mesh in (_of_faces(entry) or [])]


def _of_manifold(value: Any) -> list[Arrays] | None:
    """Read a manifold, or its mesh."""
    mesh = value.to_mesh() if callable(getattr(value, "to_mesh", None)) else value
    vertices, faces = getattr(mesh, "vert_properties", None), getattr(mesh, "tri_verts", None)
    if vertices is None or faces is None:
        return None
    return [_arrays(np.asarray(vertices)[:, :3], faces)]


def _of_kernel(value: Any) -> list[Arrays] | None:
    """Read a shape of build123d or CadQuery: a builder has it as its `part`, a workplane as its `vals()`."""
    part = getattr(value, "part", None)
    if not hasattr(value, "tessellate") and part is not None:
        value = part
    if not hasattr(value, "tessellate") and callable(getattr(value, "toCompound", None)):
        value = value.toCompound()
    if not hasattr(value, "tessellate") and callable(getattr(value, "vals", None)):
        return [mesh for entry in value.vals() for mesh in (_of_kernel(entry) or [])]
    if not callable(getattr(value, "tessellate", None)):
        return None
    vertices, faces = value.tessellate(TOLERANCE * _diagonal(value), ANGLE)
    points = [tuple(_corner(vertex)) for vertex in vertices]
    return [_arrays(np.array(points).reshape(-1, 3), np.array(faces).reshape(-1, 3))]


def _diagonal(shape: Any) -> float:
    """Return the size of a shape, by the words of build123d or of CadQuery."""
    if callable(getattr(shape, "bounding_box", None)):
        return float(shape.bounding_box().diagonal)
    if callable(getattr(shape, "BoundingBox", None)):
        return float(shape.BoundingBox().DiagonalLength)
    return 1.0


def _corner(vertex: Any) -> tuple[float, float, float]:
    names = ("X", "Y", "Z") if hasattr(vertex, "X") else ("x", "y", "z")
    if hasattr(vertex, names[0]):
        return tuple(float(getattr(vertex, name)) for name in names)  # type: ignore[return-value]
    x, y, z = vertex
    return float(x), float(y), float(z)


def _shapes(shapes: Sequence[_engine.Shape]) -> list[Arrays]:
    return [(shape.vertices(), shape.faces()) for shape in shapes]


def _file(place: Path) -> Arrays:
    mesh = read(place)
    return joined([]) if mesh is None else _arrays(*mesh)


def _bytes(data: bytes) -> Arrays:
    start = data[:512].lstrip()
    suffix = (
        ".glb"
        if data[:4] == b"glTF"
        else ".ply"
        if start[:3] == b"ply"
        else ".gltf"
        if start[:1] == b"{"
        else ".stl"
    )
    return _arrays(*reading.parsed(data, suffix))


def _arrays(vertices: Any, faces: Any) -> Arrays:
    """Check arrays, and cut faces of four corners in two."""
    try:
        points = np.ascontiguousarray(np.asarray(vertices, dtype=np.float64))
        corners = np.asarray(faces)
        if corners.size == 0:
            return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
        corners = np.ascontiguousarray(corners.astype(np.int64, casting="unsafe"))
    except (TypeError, ValueError, OverflowError):
        raise NotAMesh("its vertices or faces are no arrays of numbers") from None
    if points.ndim != 2 or points.shape[1] != 3:
        raise NotAMesh(f"its vertices have the shape {points.shape}, expected (n, 3)")
    if corners.ndim != 2 or corners.shape[1] not in (3, 4):
        raise NotAMesh(f"its faces have the shape {corners.shape}, expected (m, 3) or (m, 4)")
    if corners.min() < 0 or corners.max() >= len(points):
        worst = corners.min() if corners.min() < 0 else corners.max()
        raise NotAMesh(f"a face has the corner {worst}, and there are {len(points)} vertices, from 0")
    if corners.shape[1] == 4:
        corners = corners[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    if not np.isfinite(points[corners.ravel()]).all():
        raise NotAMesh("a coordinate of its mesh is not finite")
    return points, corners


def _is_rows(value: Any) -> bool:
    """Tell whether a value can be an array of rows of numbers: one of NumPy, or lists of numbers."""
    if isinstance(value, np.ndarray):
        return value.ndim == 2 or value.size == 0
    if not isinstance(value, list | tuple):
        return hasattr(value, "__array__")
    first: Callable[[Any], bool] = lambda row: not len(row) or isinstance(row[0], int | float | np.number)  # noqa: E731
    return not len(value) or (isinstance(value[0], list | tuple | np.ndarray) and first(value[0]))


def _shown(value: Any) -> str:
    text = " ".join(repr(value).split())
    return f"{text[:60]}..." if len(text) > 60 else text
