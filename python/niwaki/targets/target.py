"""Targets: the volumes that a scene should fill, and receivers of shadows, from OBJ, STL, PLY and GLB files or arrays.

Coordinates are those of the file: no centring, no scaling, no change of units or axes. A file with several objects is
one target; its closed parts may overlap. Enclosed space is filled, cavities as well.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki import _engine, draw, targets
from niwaki._engine import Shape
from niwaki.draw.scene import Scene
from niwaki.errors import FileError, InputError
from niwaki.errors.settings import bad
from niwaki.errors.warned import warn
from niwaki.inputs.guard import reason_of
from niwaki.targets.camera import Camera
from niwaki.targets.memory import BYTES_PER_TRIANGLE, check_memory

if TYPE_CHECKING:
    from PIL.Image import Image


#: The largest distance of a coordinate from 0, and the smallest longest side: volumes stay finite, also in 32 bits.
FARTHEST, SHORTEST = 1e12, 1e-9


class TargetWarning(UserWarning):
    """A target can be used, but perhaps not as its author meant."""


class Mesh:
    """A triangle mesh with a name; `Target` and `Receiver` are its two uses.

    Attributes
    ----------
    vertices : (n, 3) float64
        Scene units, finite.
    faces : (m, 3) int64
    name : str
        Its name in captions and messages.
    source : str or None
        Its origin: the whole path of its file, or `gallery:` and a name.
    """

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, name: str) -> None:
        self.vertices: NDArray[np.float64] = _rows(vertices, np.float64, name)
        self.faces: NDArray[np.int64] = _rows(faces, np.int64, name)
        self.name = name
        self.source: str | None = None

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Self:
        """Read a mesh from a file whose name ends in .obj, .stl, .ply, .glb or .gltf.

        Raises
        ------
        FileError
            The file is missing, cut short, of another format or larger than is read; it has no triangles, or
            coordinates that are not finite or beyond 1e12; a target has no thickness.

        Warns
        -----
        TargetWarning
            The mesh of a target is not closed; counts its open edges.
        """
        vertices, faces = targets.reading.load(path)
        mesh = cls(vertices, faces, name=str(path))
        mesh.source = str(Path(path).resolve())
        return mesh

    @classmethod
    def of(cls, mesh: Self | str | PathLike[str]) -> Self:
        """Return a mesh as it is, or load it from a file; for a target also from `gallery:` and the name of an example.

        Raises
        ------
        InputError
            The value is neither a mesh nor a path.
        FileError
            As for `load`.
        """
        if isinstance(mesh, cls):
            return mesh
        if not isinstance(mesh, str | PathLike):
            raise bad(
                cls.__name__.lower(), mesh, "a mesh, or the file of one", '`niwaki.Target.load("ship.obj")`'
            )
        return cls.find(str(mesh))

    @classmethod
    def find(cls, source: str) -> Self:
        """Load the mesh of a `source`."""
        return cls.load(source)

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Low and high corner, (2, 3)."""
        used = self.vertices[self.faces.ravel()]
        return np.stack([used.min(axis=0), used.max(axis=0)])

    def _freeze(self) -> None:
        self.vertices.setflags(write=False)
        self.faces.setflags(write=False)


class Target(Mesh):
    """A triangle mesh to fill.

    Everything that the outside does not reach is filled, cavities included: a surface inside of another makes no hole,
    whichever way it faces. The triangulation of a flat polygon makes no difference.

    Parameters
    ----------
    vertices : (n, 3) float64
        Scene units, finite.
    faces : (m, 3) int64
        Counter-clockwise seen from outside.
    name
        Its name in captions and messages.

    Attributes
    ----------
    open_edges : int
        Edges that do not lie between exactly two triangles; 0 for a closed mesh.

    Examples
    --------
    >>> tetrahedron = Target([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                      [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> tetrahedron.open_edges, round(tetrahedron.volume, 6)
    (0, 0.166667)
    """

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, name: str = "target") -> None:
        super().__init__(vertices, faces, name)
        count = len(self.faces)
        check_memory(name, f"{count:,} triangles", count * BYTES_PER_TRIANGLE)
        _check(self.vertices, self.faces, name)
        self.vertices, self.faces = _welded(self.vertices, self.faces)
        if len(self.faces) == 0:
            raise FileError("target-empty", name, reason="all of its triangles have no area")
        self._freeze()
        self.open_edges = _open_edges(self.faces)
        if self.open_edges:
            warn(
                f"{name}: the mesh is not closed: {self.open_edges} open edges; "
                "through a hole wider than a voxel the outside comes in, and only the surface is filled; "
                "close the holes if the fill looks wrong",
                TargetWarning,
            )

    @classmethod
    def of_shapes(cls, *shapes: Shape) -> Target:
        """Make a target of shapes, which may overlap: `Target.of_shapes(box((0, 3, 0), (3, 6, 3)))`."""
        vertices, faces = Scene([("target", shapes)]).merged(fine=False)
        return cls(vertices, faces)

    @classmethod
    def find(cls, source: str) -> Target:
        """Load the target of a `source`: a file, or `gallery:` and the name of an example."""
        example = targets.examples.TARGETS.get(source.removeprefix("gallery:").replace("-", "_"))
        if source.startswith("gallery:") and example is not None:
            target = example()
            target.source = f"gallery:{example.__name__}"
            return target
        if source.startswith("gallery:") and not Path(source).exists():
            raise InputError("no-example", name=source, examples=", ".join(sorted(targets.examples.TARGETS)))
        return cls.load(source)

    def __repr__(self) -> str:
        """Return name, triangles and extent."""
        x, y, z = self.size
        return f"<Target {self.name}: {len(self.faces)} triangles, {x:.3g} x {y:.3g} x {z:.3g}>"

    @property
    def size(self) -> NDArray[np.float64]:
        """Extent along x, y and z, (3,)."""
        low, high = self.bounds
        return np.asarray(high - low)

    @property
    def volume(self) -> float:
        """Signed volume of a closed mesh; overlapping parts count twice."""
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)

    def picture(self, **settings: Any) -> Image:
        """Draw the target as a solid of grey clay; settings as for a scene's picture."""
        clay = _engine.shape("mesh", self.vertices, self.faces, color=(0.72, 0.71, 0.69))
        return Scene([(self.name, [clay])]).picture(**settings)

    def _repr_png_(self) -> bytes:
        return draw.picture.png(self.picture(size=(800, 600)))


class Receiver(Mesh):
    """A surface that a shadow falls on: a floor, a wall, any mesh. It may be flat and open.

    Parameters
    ----------
    vertices : (n, 3) float64
        Scene units, finite.
    faces : (m, 3) int64
        In either orientation.
    name
        Its name in messages.

    Examples
    --------
    >>> Receiver.floor(0.0, (-5, -5), (5, 5)).bounds.tolist()
    [[-5.0, 0.0, -5.0], [5.0, 0.0, 5.0]]
    """

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, name: str = "receiver") -> None:
        super().__init__(vertices, faces, name)
        _check_arrays(self.vertices, self.faces, name)
        self._freeze()

    @classmethod
    def floor(
        cls,
        y: float = 0.0,
        low: tuple[float, float] = (-10.0, -10.0),
        high: tuple[float, float] = (10.0, 10.0),
    ) -> Receiver:
        """Make a flat rectangle at height `y` between two corners (x, z)."""
        (x0, z0), (x1, z1) = low, high
        corners = [[x0, y, z0], [x0, y, z1], [x1, y, z1], [x1, y, z0]]
        return cls(corners, [[0, 1, 2], [0, 2, 3]], name="floor")

    def __repr__(self) -> str:
        """Return name and triangles."""
        return f"<Receiver {self.name}: {len(self.faces)} triangles>"

    def camera(self, light: tuple[float, float, float], aspect: float = 1.0) -> Camera:
        """Make the light's own view: orthographic, along the light, as wide as the receiver along x.

        Parameters
        ----------
        light
            Direction in which the light travels.
        aspect
            Width of the picture over its height.
        """
        low, high = self.bounds
        middle, extent = (low + high) / 2, high - low
        along = np.asarray(light, dtype=np.float64)
        along = along / np.linalg.norm(along)
        eye = middle - along * (float(np.linalg.norm(extent)) + 1.0)
        # -z is the top of a picture seen from above, as in the original.
        up = (0.0, 0.0, -1.0) if abs(along[2]) < 0.999 else (0.0, 1.0, 0.0)
        width = float(extent[0]) or float(np.linalg.norm(extent))
        return Camera.orthographic(eye.tolist(), middle.tolist(), up, height=width / aspect)


def _rows(values: ArrayLike, dtype: type[np.generic], name: str) -> NDArray[Any]:
    """Return numbers in rows of three."""
    try:
        return np.array(values, dtype=dtype).reshape(-1, 3)
    except (TypeError, ValueError, OverflowError) as error:
        raise FileError("file-unreadable", name, suffix="a mesh", reason=reason_of(error)) from None


def _check_arrays(vertices: NDArray[np.float64], faces: NDArray[np.int64], name: str) -> None:
    if len(faces) == 0:
        raise FileError("target-empty", name, reason=f"it has {len(vertices)} vertices and no faces")
    if faces.min() < 0 or faces.max() >= len(vertices):
        reason = f"a face names vertex {int(faces.max())}, but there are {len(vertices)}, counted from 0"
        raise FileError("file-unreadable", name, suffix="a mesh", reason=reason)
    wrong = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if len(wrong):
        raise FileError("target-not-finite", name, count=len(wrong), total=len(vertices), first=int(wrong[0]))
    _check_size(vertices[faces.ravel()], name)


def _check_size(corners: NDArray[np.float64], name: str) -> None:
    """Refuse coordinates whose products would not be numbers."""
    largest = float(np.abs(corners).max())
    if largest > FARTHEST:
        reason = f"a coordinate is {largest:.3g} from 0, and the limit is {FARTHEST:g}"
        raise FileError("target-size", name, found="large", reason=reason)
    extent = float((corners.max(axis=0) - corners.min(axis=0)).max())
    if 0.0 < extent < SHORTEST:
        reason = f"its longest side is {extent:.3g}, and the limit is {SHORTEST:g}"
        raise FileError("target-size", name, found="small", reason=reason)


def _check(vertices: NDArray[np.float64], faces: NDArray[np.int64], name: str) -> None:
    _check_arrays(vertices, faces, name)
    corners = vertices[faces.ravel()]
    extent = corners.max(axis=0) - corners.min(axis=0)
    if (extent <= 1e-9 * extent.max()).any():
        axis = "xyz"[int(extent.argmin())]
        raise FileError("target-flat", name, axis=axis, extent=" x ".join(f"{e:.4g}" for e in extent))


def _welded(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Merge equal vertices, in order of first use. Unused vertices and faces without three different corners go."""
    is_used = np.zeros(len(vertices), dtype=bool)
    is_used[faces.ravel()] = True
    used = np.flatnonzero(is_used)
    # -0.0 and 0.0 are equal. Sorted by coordinates, equal places follow each other; the sort is stable, so that
    # the first of them is the one with the lowest number.
    points = vertices[used] + 0.0
    order = np.lexsort(points.T[::-1])
    rows = points[order]
    starts = np.ones(len(order), dtype=bool)
    starts[1:] = (rows[1:] != rows[:-1]).any(axis=1)
    first = np.empty_like(order)
    first[order] = order[starts][np.cumsum(starts) - 1]
    is_first = first == np.arange(len(first))
    number = np.empty(len(vertices), dtype=np.int64)
    number[used] = (np.cumsum(is_first) - 1)[first]
    merged = number[faces]
    a, b, c = merged.T
    return points[is_first], merged[(a != b) & (b != c) & (c != a)]


def _open_edges(faces: NDArray[np.int64]) -> int:
    count = int(faces.max()) + 1
    # An edge is one number, in either direction: there are fewer than 2^31 vertices.
    edges = np.concatenate(
        [
            np.minimum(faces[:, k], faces[:, k - 1]) * count + np.maximum(faces[:, k], faces[:, k - 1])
            for k in range(3)
        ]
    )
    edges.sort()
    ends = np.flatnonzero(np.append(edges[1:] != edges[:-1], True))
    uses = np.diff(ends, prepend=-1)
    # Two closed parts may share an edge; an odd count is a hole.
    return int((uses % 2 == 1).sum())
