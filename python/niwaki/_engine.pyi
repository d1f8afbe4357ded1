"""The compiled engine: what the door between Python and Rust offers."""

from collections.abc import Sequence
from typing import Literal, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Shape",
    "Sketch",
    "SketchSpec",
    "Target",
    "__version__",
    "fine_mesh",
    "frame_camera",
    "no_self_intersection",
    "render",
    "volume_match",
]

__version__: str

_Triple = Sequence[float]
_Rows = Sequence[Sequence[float]]
_Corner = tuple[float, float, float]
_Eye = tuple[_Corner, _Corner, _Corner, float]
_Mesh = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64] | None, _Corner, _Corner]

@final
class Shape:
    @staticmethod
    def box(
        center: _Triple,
        size: _Triple,
        rotation: _Rows | None = None,
        taper: float = 1.0,
        taper_axis: str = "z",
        bevel: float | None = None,
        color: _Triple | None = None,
    ) -> Shape: ...
    @staticmethod
    def cylinder(
        center: _Triple,
        radius: float,
        length: float,
        axis: str | _Triple = ...,
        top_radius: float | None = None,
        rotation: _Rows | None = None,
        bevel: float | None = None,
        color: _Triple | None = None,
    ) -> Shape: ...
    @staticmethod
    def limb(
        start: _Triple,
        end: _Triple,
        start_radius: float,
        end_radius: float,
        start_normal: _Triple | None = None,
        end_normal: _Triple | None = None,
        color: _Triple | None = None,
    ) -> Shape: ...
    @staticmethod
    def mesh(
        vertices: NDArray[np.float64],
        faces: NDArray[np.int64],
        center: _Triple = ...,
        rotation: _Rows | None = None,
        scale: float = 1.0,
        color: _Triple | None = None,
    ) -> Shape: ...
    @property
    def kind(self) -> str: ...
    @property
    def color(self) -> list[float] | None: ...
    def aabb(self) -> tuple[list[float], list[float]]: ...
    def vertices(self) -> NDArray[np.float64]: ...
    def faces(self) -> NDArray[np.int64]: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...

@final
class Target:
    def __new__(cls, vertices: NDArray[np.float64], faces: NDArray[np.int64], voxel: float) -> Target: ...
    @property
    def dims(self) -> tuple[int, int, int]: ...
    @property
    def filled(self) -> int: ...
    @property
    def domain(self) -> tuple[list[float], list[float]]: ...
    @property
    def triangles(self) -> int: ...
    @property
    def open_edges(self) -> int: ...
    def vertices(self) -> NDArray[np.float64]: ...
    def faces(self) -> NDArray[np.int64]: ...
    def cells(self) -> NDArray[np.bool_]: ...

@final
class SketchSpec:
    @property
    def name(self) -> str: ...

@final
class Sketch:
    def __new__(cls, specs: Sequence[SketchSpec]) -> Sketch: ...
    def add(self, shapes: Sequence[Shape]) -> str | None: ...
    def remove(self, shapes: Sequence[Shape]) -> None: ...
    def log_score(self) -> float: ...
    def similarity(self) -> float | None: ...
    def measures(self) -> dict[str, float]: ...
    def fork(self) -> Sketch: ...

def volume_match(target: Target, sigma: float = 0.02) -> SketchSpec: ...
def no_self_intersection(rule: Literal["solid", "surface"] = "solid") -> SketchSpec: ...
def render(
    meshes: Sequence[_Mesh],
    ghost: _Mesh | None = None,
    *,
    camera: _Eye | None = None,
    width: int = 640,
    height: int = 480,
    samples: int = 16,
    backdrop: tuple[_Corner, _Corner] | None = None,
    floor: float | None = None,
    ghost_color: _Corner | None = None,
) -> NDArray[np.uint8]: ...
def frame_camera(
    points: NDArray[np.float64],
    *,
    azimuth: float | None = None,
    elevation: float | None = None,
    fov_y: float | None = None,
    margin: float | None = None,
    aspect: float = ...,
) -> _Eye: ...
def fine_mesh(shape: Shape) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]: ...
