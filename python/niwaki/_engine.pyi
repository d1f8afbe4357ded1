"""The compiled engine: what the door between Python and Rust offers."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BadParameter",
    "Chains",
    "Checkpoint",
    "Choice",
    "Coordinates",
    "Density",
    "Drawing",
    "EngineFault",
    "Guide",
    "Lessons",
    "Opaque",
    "Picture",
    "Placer",
    "Positions",
    "Program",
    "Run",
    "SHAPES",
    "Shape",
    "Site",
    "Sketch",
    "SketchSpec",
    "Target",
    "Task",
    "Trace",
    "Trajectories",
    "__version__",
    "agreement",
    "check_inside",
    "different",
    "draw",
    "draw_at",
    "enumerate_support",
    "explain",
    "family_names",
    "fine_mesh",
    "fingerprint",
    "frame_camera",
    "guide_net",
    "guide_slope",
    "guide_steps",
    "log_density",
    "matches",
    "nearest",
    "parameter_names",
    "render",
    "support",
    "unique_models",
]

__version__: str

#: The words for shapes, and the parameters of each in order.
SHAPES: dict[str, list[str]]

_Triple = Sequence[float]
_Rows = Sequence[Sequence[float]]
_Frame = tuple[_Triple, _Triple, _Triple, float]
_Bark = tuple[_Triple, float, _Triple, float]
_End = tuple[list[float], float]
_Corner = tuple[float, float, float]
_Lens = tuple[_Triple, _Triple, _Triple, bool, float, float]
_Eye = tuple[_Corner, _Corner, _Corner, float]
_Surface = tuple[float, float, float, float]
_Mesh = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64] | None, _Corner, _Surface]

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
        metalness: float | None = None,
        roughness: float | None = None,
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
        metalness: float | None = None,
        roughness: float | None = None,
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
        metalness: float | None = None,
        roughness: float | None = None,
    ) -> Shape: ...
    @staticmethod
    def segment(
        start: _Frame,
        split: _Frame,
        end: _Frame,
        onto: _Bark | None = None,
        color: _Triple | None = None,
        metalness: float | None = None,
        roughness: float | None = None,
    ) -> Shape: ...
    @staticmethod
    def mesh(
        vertices: NDArray[np.float64],
        faces: NDArray[np.int64],
        center: _Triple = ...,
        rotation: _Rows | None = None,
        scale: float = 1.0,
        color: _Triple | None = None,
        metalness: float | None = None,
        roughness: float | None = None,
    ) -> Shape: ...
    @staticmethod
    def stroke(
        start: _Triple,
        end: _Triple,
        width: float,
        end_width: float | None = None,
        color: _Triple | None = None,
    ) -> Shape: ...
    @staticmethod
    def ellipse(
        center: _Triple, length: float, width: float, angle: float = 0.0, color: _Triple | None = None
    ) -> Shape: ...
    @staticmethod
    def disc(center: _Triple, radius: float, color: _Triple | None = None) -> Shape: ...
    def data(self) -> str: ...
    @staticmethod
    def of_data(data: str) -> Shape: ...
    @property
    def kind(self) -> str: ...
    @property
    def color(self) -> list[float] | None: ...
    @property
    def metalness(self) -> float | None: ...
    @property
    def roughness(self) -> float | None: ...
    def aabb(self) -> tuple[list[float], list[float]]: ...
    def flat(self) -> tuple[_End, _End] | tuple[list[float], float, float, float] | None: ...
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
    def mask(self, shapes: Sequence[Shape]) -> NDArray[np.bool_]: ...

@final
class SketchSpec:
    def __new__(
        cls,
        form: str,
        target: Target | None = None,
        picture: Picture | None = None,
        drawing: Drawing | None = None,
    ) -> SketchSpec: ...
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

@final
class Picture:
    def __new__(
        cls,
        camera: _Lens,
        on: NDArray[np.bool_],
        greys: NDArray[np.uint8] | None = None,
        multiplier: float = 10.0,
        receiver: tuple[NDArray[np.float64], NDArray[np.int64]] | None = None,
        light: _Triple | None = None,
    ) -> Picture: ...
    @property
    def size(self) -> tuple[int, int]: ...
    @property
    def on_fraction(self) -> float: ...
    def mask(self, shapes: Sequence[Shape]) -> NDArray[np.bool_]: ...
    def seen(self) -> NDArray[np.bool_]: ...

@final
class Drawing:
    def __new__(cls, greys: NDArray[np.uint8], low: Sequence[float], high: Sequence[float]) -> Drawing: ...
    @property
    def size(self) -> tuple[int, int]: ...
    def mask(self, shapes: Sequence[Shape]) -> NDArray[np.bool_]: ...

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

class BadParameter(ValueError):
    family: str
    parameter: str
    found: str
    expected: str

#: Function, path, (line, column, end line, end column).
_Place = tuple[str, str, tuple[int, int, int, int]]

#: Address, function, path, (line, column, end line, end column).
_Emitted = tuple[str, str, str, tuple[int, int, int, int]]

class EngineFault(RuntimeError):
    kind: Literal["run", "setting", "impossible", "no-start", "compile"]
    code: str
    message: str
    help: str | None
    subject: str | None
    stack: list[_Place]
    omitted: int
    path: str
    invalid: bool
    barrier: int
    tries: int
    causes: list[tuple[str, int]]
    blame: list[tuple[str, _Emitted, _Emitted | None, int]]
    looked_at: int
    attempts: list[tuple[str, int, int | None]]

def log_density(family: str, params: Sequence[Any], x: Any) -> float: ...
def draw(family: str, params: Sequence[Any], seed: int, n: int) -> list[Any]: ...
def draw_at(family: str, params: Sequence[Any], seed: int, stream: int, address: int, visit: int) -> Any: ...
def support(family: str, params: Sequence[Any]) -> tuple[str, Any, Any]: ...
def enumerate_support(family: str, params: Sequence[Any]) -> list[Any] | None: ...
def family_names() -> list[str]: ...
def parameter_names(family: str) -> list[str]: ...

_Watch = Callable[[int, int, float, Run | None], object]

@final
class Program:
    def __new__(cls, text: str, constants: Sequence[Any] = ..., classes: Sequence[type] = ...) -> Program: ...
    @property
    def seconds(self) -> float: ...
    @property
    def functions(self) -> list[tuple[str, str, int]]: ...
    @property
    def choices(self) -> list[tuple[str, str, int]]: ...
    def disassemble(self) -> str: ...

@final
class Task:
    def __new__(
        cls,
        program: Program,
        args: Sequence[Any] = ...,
        sketches: Sequence[SketchSpec] = ...,
        max_steps: int = 20000000,
        max_memory: int = ...,
    ) -> Task: ...
    def search(
        self,
        method: str,
        seed: int,
        *,
        attached: Sequence[Task | Guide] = ...,
        start: Run | None = None,
        threads: int | None = None,
        watch: _Watch | None = None,
        checkpoint: Checkpoint | None = None,
    ) -> tuple[list[Run], bool, dict[str, Any]]: ...
    def holding(self, lock: Mapping[str, Any]) -> Task: ...
    def uncounted(self) -> Task: ...
    def invalid(self) -> dict[str, int]: ...
    def infer(self, constant: object, seed: int) -> Any: ...
    def density(self, run: Run) -> Density: ...
    def trace(self, run: Run) -> Trace: ...
    def placer(self, run: Run) -> Placer: ...
    def regrow(
        self,
        run: Run,
        part: str,
        particles: int,
        power: float,
        seed: int,
        threads: int | None = None,
    ) -> list[Run]: ...
    def gain(self, run: Run) -> float: ...
    def run_of_data(self, data: str) -> Run: ...
    def replay(self, choices: Mapping[str, Any], seed: int | None = None, partial: bool = False) -> Trace: ...

def agreement(
    task: Task,
    method: str,
    seed: int,
    steps: int,
    every: int = 20,
    attached: Sequence[Task | Guide] = ...,
) -> tuple[str | None, int, int, int]: ...
def matches(pattern: str, address: str) -> bool: ...
def nearest(pattern: str, addresses: Sequence[str]) -> list[str]: ...
def fingerprint() -> str: ...
def guide_net(form: str, seed: int) -> bytes: ...
def guide_slope(net: bytes, rows: str, share: float) -> tuple[float, NDArray[np.float64]]: ...
def guide_steps(
    weights: NDArray[np.float64], slopes: NDArray[np.float64], rate: float, averaging: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def check_inside(method: str) -> None: ...
def explain(task: Task, seed: int, address: str, tries: int = 1000) -> dict[str, Any]: ...

@final
class Checkpoint:
    def __new__(cls, left: Mapping[int, str]) -> Checkpoint: ...
    def ask(self) -> None: ...
    def collect(self) -> tuple[dict[int, str], float]: ...

@final
class Chains:
    def __new__(
        cls,
        task: Task,
        method: str,
        seed: int,
        *,
        attached: Sequence[Task | Guide] = ...,
        room: int = ...,
        start: Run | None = None,
        threads: int | None = None,
        checkpoint: Checkpoint | None = None,
    ) -> Chains: ...
    def advance(
        self,
        steps: int | None = None,
        threads: int | None = None,
        watch: _Watch | None = None,
        checkpoint: Checkpoint | None = None,
    ) -> bool: ...
    def check(self) -> None: ...
    def best(self) -> list[Run]: ...
    def samples(self) -> list[list[Run]]: ...
    def now(self) -> list[Run]: ...
    def thin(self) -> list[int]: ...
    def exchanges(self) -> list[tuple[int, int]]: ...
    def sites(self) -> list[Site]: ...
    def trajectories(self) -> list[dict[str, Any]]: ...
    def counters(self) -> dict[str, int]: ...

@final
class Trajectories:
    def __new__(
        cls,
        task: Task,
        method: str,
        seed: int,
        *,
        start: Run | None = None,
        threads: int | None = None,
        watch: _Watch | None = None,
    ) -> Trajectories: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def chains(self) -> int: ...
    def choices(self, chain: int) -> list[Coordinates]: ...
    def fixed(self, chain: int) -> list[Choice]: ...
    def values(self, chain: int) -> NDArray[np.float64]: ...
    def positions(self, chain: int) -> NDArray[np.float64]: ...
    def draws(self, chain: int) -> dict[str, NDArray[Any]]: ...
    def scores(self, chain: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def counters(self, chain: int) -> dict[str, Any]: ...
    def fault(self, chain: int) -> BaseException | None: ...

@final
class Density:
    @property
    def dim(self) -> int: ...
    @property
    def start(self) -> NDArray[np.float64]: ...
    @property
    def choices(self) -> list[Coordinates]: ...
    @property
    def operations(self) -> tuple[int, int, int]: ...
    @property
    def recordings(self) -> int: ...
    @property
    def emitted(self) -> int: ...
    def value_and_gradient(self, x: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]] | None: ...
    def values(self, x: NDArray[np.float64]) -> dict[str, Any]: ...
    def compile(self) -> bool: ...
    def jax(self) -> str: ...

@final
class Placer:
    def positions(
        self,
        values: Mapping[int, float],
        free: set[int],
        arguments: Mapping[int, float] = ...,
        constants: Mapping[int, float] = ...,
    ) -> Positions: ...

@final
class Positions:
    @property
    def movables(self) -> list[tuple[int, str, bool]]: ...
    def ranges(self) -> NDArray[np.float64]: ...
    def followed(self, x: Sequence[float]) -> dict[int, float]: ...
    @property
    def parts(self) -> list[tuple[str, int]]: ...
    def frame(self, part: int, shape: int) -> NDArray[np.float64] | None: ...
    def slopes(
        self, part: int, shape: int, shares: tuple[float, float, float]
    ) -> NDArray[np.float64] | None: ...

@final
class Run:
    @property
    def log_score(self) -> float: ...
    @property
    def log_prior(self) -> float: ...
    @property
    def log_weight(self) -> float: ...
    @property
    def primitives(self) -> int: ...
    @property
    def similarity(self) -> float | None: ...
    @property
    def has_ended(self) -> bool: ...
    @property
    def cause(self) -> str | None: ...
    @property
    def value(self) -> Any: ...
    @property
    def is_bare(self) -> bool: ...
    @property
    def visit(self) -> int: ...
    def data(self) -> str: ...
    def order(self) -> list[tuple[int, int]]: ...

@final
class Choice:
    @property
    def path(self) -> str: ...
    @property
    def address(self) -> int: ...
    @property
    def family(self) -> str: ...
    @property
    def value(self) -> Any: ...
    @property
    def log_density(self) -> float: ...

@final
class Site:
    @property
    def function(self) -> str: ...
    @property
    def site(self) -> str: ...
    @property
    def line(self) -> int: ...
    @property
    def proposed(self) -> int: ...
    @property
    def accepted(self) -> int: ...
    @property
    def outside(self) -> int: ...

@final
class Coordinates:
    @property
    def name(self) -> str: ...
    @property
    def family(self) -> str: ...
    @property
    def transform(self) -> str: ...
    @property
    def first(self) -> int: ...
    @property
    def count(self) -> int: ...
    @property
    def width(self) -> int: ...
    @property
    def is_vector(self) -> bool: ...

@final
class Trace:
    @property
    def run(self) -> Run: ...
    @property
    def choices(self) -> list[Choice]: ...
    @property
    def parts(self) -> list[tuple[str, list[Shape]]]: ...
    @property
    def queries(self) -> dict[Any, Any]: ...

@final
class Opaque: ...

def unique_models(runs: Sequence[Run]) -> int: ...
def different(runs: Sequence[Run], k: int) -> list[int]: ...

@final
class Guide:
    def __new__(cls, data: bytes) -> Guide: ...
    def data(self) -> bytes: ...
    def form(self) -> str: ...
    def inputs(self) -> list[str]: ...
    def weights(self) -> int: ...
    def with_report(self, report: str) -> Guide: ...
    def lost(self, task: Task) -> list[str]: ...

@final
class Lessons:
    def __new__(cls) -> Lessons: ...
    def add(self, task: Task, run: Run, held_out: bool) -> None: ...
    def train(
        self,
        task: Task,
        settings: str,
        start: Guide | None = None,
        threads: int | None = None,
        watch: Callable[[int, int, float, Run | None], None] | None = None,
        checkpoint: Checkpoint | None = None,
    ) -> tuple[Guide, dict[str, Any]]: ...
