"""Closed meshes of cut solids for files, by manifold3d (extra `print`).

Pictures and scores read a cut solid without a library. The pieces of its surface meet without gaps, but not corner to
corner, and programs that read files expect them to.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki._engine import Shape
from niwaki.errors import FileError
from niwaki.errors.extras import optional


class Closed(NamedTuple):
    """The faces of a closed mesh that come from one solid of a cut.

    Attributes
    ----------
    leaf
        The place of the solid in the cut.
    vertices, normals : (n, 3) float64
        Points in scene units; vectors of unit length. A place where normals differ has several vertices.
    faces : (m, 3) uint32
        Counter-clockwise seen from outside.
    """

    leaf: int
    vertices: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.uint32]


def kernel() -> Any:
    """Import the library that joins and cuts solids.

    Raises
    ------
    FileError
        The library is not installed.
    """
    return optional("manifold3d", "joining and cutting solids", "print")


def closed(shape: Shape, address: str) -> list[Closed]:
    """Make the closed mesh of a cut solid, split by the solids from which its faces come.

    Raises
    ------
    FileError
        The extra `print` is not installed, or a mesh among the solids is not closed.
    """
    tools = kernel()
    leaves, steps = shape.leaves(), shape.steps()
    solids = [_solid(tools, *mesh[:3]) for mesh in _engine.meshes([[leaf] for leaf in leaves], sharp=True)]
    for leaf, solid in zip(leaves, solids, strict=True):
        if solid.status() != tools.Error.NoError or solid.volume() <= 0.0:
            listed = f"{address} (a {leaf.kind} in a cut)"
            raise FileError("not-a-solid", count=1, total=len(leaves), listed=listed)
    numbers = {solid.original_id(): number for number, solid in enumerate(solids)}
    mesh = _combined(solids, steps).to_mesh64()
    properties, corners = np.asarray(mesh.vert_properties), np.asarray(mesh.tri_verts)
    turned = _turned(steps)
    parts: list[Closed] = []
    runs = np.asarray(mesh.run_index) // 3
    for original, start, end in zip(mesh.run_original_id, runs[:-1], runs[1:], strict=True):
        if start == end:
            continue
        number = numbers[int(original)]
        used, index = np.unique(corners[start:end], return_inverse=True)
        normals = properties[used, 3:6] * (-1.0 if turned[number] else 1.0)
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = normals / np.where(lengths > 0.0, lengths, 1.0)
        faces: NDArray[np.uint32] = index.reshape(-1, 3).astype(np.uint32)
        parts.append(Closed(number, np.ascontiguousarray(properties[used, :3]), normals, faces))
    return sorted(parts, key=lambda part: part.leaf)


def _solid(tools: Any, vertices: NDArray[Any], faces: NDArray[Any], normals: NDArray[Any]) -> Any:
    """Convert a fine mesh to a solid whose vertices carry their normals."""
    _, first, index = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
    kept = first[index.reshape(-1)]
    # A triangle whose corners are at two places has no area.
    a, b, c = kept[faces].T
    whole = faces[(a != b) & (b != c) & (c != a)]
    doubled = np.flatnonzero(kept != np.arange(len(vertices)))
    mesh = tools.Mesh64(
        np.hstack([vertices, normals]),
        whole.astype(np.uint64),
        merge_from_vert=doubled.astype(np.uint64),
        merge_to_vert=kept[doubled].astype(np.uint64),
    )
    # An original has a number, by which its faces are known in a result.
    return tools.Manifold(mesh).as_original()


def _combined(solids: list[Any], steps: list[str]) -> Any:
    """Apply the operators of a cut."""
    stack: list[Any] = []
    waiting = iter(solids)
    for step in steps:
        if step == "solid":
            stack.append(next(waiting))
            continue
        second, first = stack.pop(), stack.pop()
        stack.append({"-": first.__sub__, "&": first.__xor__, "|": first.__add__}[step](second))
    return stack.pop()


def _turned(steps: list[str]) -> list[bool]:
    """Tell for each solid whether its faces look inwards: it is subtracted, and not from something subtracted."""
    stack: list[list[bool]] = []
    for step in steps:
        if step == "solid":
            stack.append([False])
            continue
        second, first = stack.pop(), stack.pop()
        stack.append([*first, *(turned != (step == "-") for turned in second)])
    return stack.pop()
