"""A large mesh with fewer triangles, for display: made once, when the mesh is uploaded, and stored beside it.

HASH.stl         the mesh
HASH.light.stl   the thinned mesh, with about `GHOST_TRIANGLES` triangles
HASH.json        the bounds and the number of triangles of the mesh
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal

import msgspec
import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from niwaki.draw.print_files import triangles_stl
from niwaki.errors import NiwakiError
from niwaki.errors.files import is_file, write_whole
from niwaki.errors.schema import Unfit, decoded, fitted
from niwaki.inputs import bytes_of
from niwaki.targets.target import Target

#: Approximate limit of the triangles of a ghost.
GHOST_TRIANGLES = 60_000


class About(Struct):
    """The contents of HASH.json: bounds (scene units) and triangles of the full mesh."""

    bounds: tuple[tuple[float, float, float], tuple[float, float, float]]
    triangles: Annotated[int, Meta(ge=0, lt=2**53)]


@dataclass(frozen=True)
class Ghost:
    """A mesh as it is shown: thinned if it is large.

    Attributes
    ----------
    vertices, faces
        Vertices and faces of the thinned mesh.
    bounds : (2, 3) float64
        Bounds of the full mesh.
    triangles : int
        Number of triangles of the full mesh.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    bounds: NDArray[np.float64]
    triangles: int

    @classmethod
    def of(cls, target: Target) -> Ghost:
        """Make the ghost of a target."""
        vertices, faces = thinned(np.asarray(target.vertices), np.asarray(target.faces))
        return cls(vertices, faces, np.asarray(target.bounds), len(target.faces))

    def stood(self, up: Literal["y", "z"]) -> Ghost:
        """Return the ghost stood up, if its z axis points up."""
        if up == "y":
            return self
        corners = stood(self.bounds)
        return replace(self, vertices=stood(self.vertices), bounds=np.sort(corners, axis=0))

    def save(self, mesh: Path) -> None:
        """Write the ghost beside its mesh."""
        write_whole(mesh.with_suffix(".light.stl"), stl(self.vertices, self.faces))
        low, high = self.bounds.tolist()
        about = About((tuple(low), tuple(high)), self.triangles)
        write_whole(mesh.with_suffix(".json"), msgspec.json.encode(about))

    @classmethod
    def beside(cls, mesh: Path) -> Ghost | None:
        """Read the ghost beside a mesh; None without a usable ghost."""
        place = mesh.with_suffix(".json")
        if not is_file(place):
            return None
        try:
            about = fitted(decoded(bytes_of(place, "session")), About)
            light = Target.load(mesh.with_suffix(".light.stl"))
        except (Unfit, NiwakiError):
            return None
        return cls(
            np.asarray(light.vertices), np.asarray(light.faces), np.array(about.bounds), about.triangles
        )


def stood(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn points about x so that their z axis points up."""
    x, y, z = np.asarray(points, dtype=np.float64).T
    return np.stack([x, z, -y], axis=1)


def stl(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> bytes:
    """Write a mesh as binary STL, in scene units."""
    return triangles_stl(vertices[faces], "binary STL by niwaki, scene units, y up")


def thinned(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], most: int = GHOST_TRIANGLES
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Thin a mesh to about `most` triangles: the vertices in a cell of a grid become one (Rossignac, Borrel 1993)."""
    cells = 256
    extent = float(np.ptp(vertices, axis=0).max()) or 1.0
    while len(faces) > most and cells > 8:
        grid = np.floor((vertices - vertices.min(axis=0)) * (cells / extent)).astype(np.int64)
        key = (grid[:, 0] * (cells + 1) + grid[:, 1]) * (cells + 1) + grid[:, 2]
        _, first, number = np.unique(key, return_index=True, return_inverse=True)
        merged = number[faces]
        a, b, c = merged.T
        merged = np.unique(merged[(a != b) & (b != c) & (c != a)], axis=0)
        if len(merged) <= most:
            return vertices[first], merged
        cells = cells * 3 // 4
    return vertices, faces
