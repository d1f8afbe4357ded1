"""A large mesh with fewer triangles, for the eye: made once, when the mesh arrives, and kept beside it.

HASH.stl         the mesh
HASH.light.stl   about `GHOST_TRIANGLES` of it
HASH.json        its true bounds, and how many triangles it has
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import msgspec
import numpy as np
import trimesh
from msgspec import Meta, Struct
from numpy.typing import NDArray

from niwaki.errors import NiwakiError
from niwaki.errors.files import is_file, write_whole
from niwaki.errors.schema import Unfit, decoded, fitted
from niwaki.inputs import bytes_of
from niwaki.targets.target import Target

#: The ghost of a target has no more triangles than about this.
GHOST_TRIANGLES = 60_000


class About(Struct):
    """What HASH.json says of the mesh itself; corners of its bounds in scene units."""

    bounds: tuple[tuple[float, float, float], tuple[float, float, float]]
    triangles: Annotated[int, Meta(ge=0, lt=2**53)]


@dataclass(frozen=True)
class Ghost:
    """What is shown of a mesh.

    Attributes
    ----------
    vertices, faces
        Of the thinned mesh.
    bounds : (2, 3) float64
        Of the mesh itself.
    triangles : int
        Of the mesh itself.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    bounds: NDArray[np.float64]
    triangles: int

    @classmethod
    def of(cls, target: Target) -> Ghost:
        """The ghost of a target."""
        vertices, faces = thinned(np.asarray(target.vertices), np.asarray(target.faces))
        return cls(vertices, faces, np.asarray(target.bounds), len(target.faces))

    def save(self, mesh: Path) -> None:
        """Keep it beside its mesh."""
        light = trimesh.Trimesh(self.vertices, self.faces, process=False)
        write_whole(mesh.with_suffix(".light.stl"), stl(light))
        low, high = self.bounds.tolist()
        about = About((tuple(low), tuple(high)), self.triangles)
        write_whole(mesh.with_suffix(".json"), msgspec.json.encode(about))

    @classmethod
    def beside(cls, mesh: Path) -> Ghost | None:
        """The ghost that is kept beside a mesh, where there is one that can be used; else it is made again."""
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


def stl(mesh: trimesh.Trimesh) -> bytes:
    """The bytes of a mesh as binary STL."""
    data: Any = mesh.export(file_type="stl")
    return bytes(data)


def thinned(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], most: int = GHOST_TRIANGLES
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """A mesh of about `most` triangles at most: vertices of one cell of a grid become one (Rossignac, Borrel 1993)."""
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
