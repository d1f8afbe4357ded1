"""The compiled engine: what the door between Python and Rust offers."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "BadParameter",
    "Chains",
    "Density",
    "EngineFault",
    "Opaque",
    "Outcome",
    "Picture",
    "Program",
    "Shape",
    "Sketch",
    "SketchSpec",
    "Target",
    "Task",
    "Trace",
    "Trajectories",
    "__version__",
    "agreement",
    "avoid",
    "different",
    "draw",
    "draw_at",
    "enumerate_support",
    "explain",
    "family_names",
    "fine_mesh",
    "floor",
    "frame_camera",
    "log_density",
    "match_image",
    "match_shadow",
    "no_self_intersection",
    "overshoot",
    "parameter_names",
    "render",
    "support",
    "unique_models",
    "volume_match",
]

__version__: str

_Triple = Sequence[float]
_Rows = Sequence[Sequence[float]]
_Frame = tuple[_Triple, _Triple, _Triple, float]
_Bark = tuple[_Triple, float, _Triple, float]
_Corner = tuple[float, float, float]
_Lens = tuple[_Triple, _Triple, _Triple, bool, float, float]
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
    def segment(
        start: _Frame,
        split: _Frame,
        end: _Frame,
        onto: _Bark | None = None,
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
def no_self_intersection(rule: str = "solid") -> SketchSpec: ...

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

def match_image(picture: Picture, sigma: float = 0.02) -> SketchSpec: ...
def match_shadow(picture: Picture, sigma: float = 0.02) -> SketchSpec: ...
def avoid(obstacle: Target) -> SketchSpec: ...
def floor(height: float) -> SketchSpec: ...
def overshoot(low: _Triple, high: _Triple, sigma: float = 0.02) -> SketchSpec: ...
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

class EngineFault(RuntimeError):
    kind: Literal["run", "setting", "impossible", "no-start", "compile"]
    code: str
    message: str
    help: str | None
    stack: list[tuple[str, str, tuple[int, int, int, int]]]
    omitted: int
    path: str
    invalid: bool
    barrier: int
    causes: list[tuple[str, int]]

def log_density(family: str, params: Sequence[Any], x: Any) -> float: ...
def draw(family: str, params: Sequence[Any], seed: int, n: int) -> list[Any]: ...
def draw_at(family: str, params: Sequence[Any], seed: int, stream: int, address: int, visit: int) -> Any: ...
def support(family: str, params: Sequence[Any]) -> tuple[str, Any, Any]: ...
def enumerate_support(family: str, params: Sequence[Any]) -> list[Any] | None: ...
def family_names() -> list[str]: ...
def parameter_names(family: str) -> list[str]: ...

_Watch = Callable[[int, int, float], object]

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
    def uncounted(self) -> Task: ...
    def invalid(self) -> dict[str, int]: ...
    def forward(self, seed: int, n: int = 1, watch: _Watch | None = None) -> list[Outcome]: ...
    def enumerate(
        self, max_runs: int, watch: _Watch | None = None
    ) -> tuple[list[tuple[Any, float]], float, int]: ...
    def rejection(
        self, n: int, bound: float, max_tries: int, seed: int, watch: _Watch | None = None
    ) -> tuple[list[Outcome], int, bool]: ...
    def importance(
        self, n: int, seed: int, threads: int | None = None, watch: _Watch | None = None
    ) -> tuple[list[Outcome], float]: ...
    def smc(
        self,
        plan: Sequence[int],
        seed: int,
        *,
        order: str = "stochastic",
        weights: str = "ratio",
        temper: float = 1.0,
        anneal: float | Sequence[float] | None = None,
        resampling: str = "systematic",
        ess: float | None = None,
        rejuvenate: tuple[Any, ...] | None = None,
        moves: int = 1,
        at: int | str = ...,
        walks: tuple[int, int] | None = None,
        seconds: float | None = None,
        threads: int | None = None,
        watch: _Watch | None = None,
    ) -> dict[str, Any]: ...
    def particle_gibbs(
        self,
        particles: int,
        sweeps: int,
        seed: int,
        *,
        order: str = "stochastic",
        temper: float = 1.0,
        anneal: float | Sequence[float] | None = None,
        ess: float | None = None,
        ancestors: bool = True,
        start: Outcome | None = None,
        threads: int | None = None,
        watch: _Watch | None = None,
    ) -> dict[str, Any]: ...
    def pimh(
        self,
        particles: int,
        sweeps: int,
        seed: int,
        *,
        order: str = "stochastic",
        temper: float = 1.0,
        anneal: float | Sequence[float] | None = None,
        resampling: str = "systematic",
        ess: float | None = None,
        threads: int | None = None,
        watch: _Watch | None = None,
    ) -> dict[str, Any]: ...
    def infer(self, method: object, seed: int) -> Any: ...
    def density(self, choices: Sequence[tuple[int, Any]]) -> Density: ...
    def trace(self, outcome: Outcome) -> Trace: ...
    def replay(self, choices: Mapping[str, Any], seed: int | None = None, partial: bool = False) -> Trace: ...

def agreement(
    task: Task,
    seed: int,
    steps: int,
    every: int = 20,
    kernel: tuple[Any, ...] | None = None,
    warmup: int = 0,
) -> tuple[str | None, int, int, int]: ...
def explain(task: Task, seed: int, address: str, tries: int = 1000) -> dict[str, Any]: ...

@final
class Chains:
    def __new__(
        cls,
        task: Task,
        seed: int,
        *,
        chains: int = 1,
        strategy: str = "c3",
        warmup: int = 0,
        thin: int = 1,
        room: int = ...,
        tries: int = 1000,
        known: Mapping[int, Any] | None = None,
        kernel: tuple[Any, ...] | None = None,
        temperatures: Sequence[float] | None = None,
        every: int = 100,
        threads: int | None = None,
    ) -> Chains: ...
    def advance(self, steps: int, threads: int | None = None, watch: _Watch | None = None) -> bool: ...
    def best(self) -> list[Outcome]: ...
    def samples(self, chain: int, start: int = 0) -> list[tuple[int, Outcome]]: ...
    def now(self) -> list[Outcome]: ...
    def thin(self) -> list[int]: ...
    def exchanges(self) -> list[tuple[int, int]]: ...
    def sites(self) -> list[tuple[str, str, int, int, int, int]]: ...
    def trajectories(self) -> list[dict[str, Any]]: ...
    def counters(self) -> dict[str, int]: ...

@final
class Trajectories:
    def __new__(
        cls,
        task: Task,
        seed: int,
        *,
        chains: int,
        draws: int,
        warmup: int,
        thin: int,
        target_accept: float,
        metric: str,
        step_size: float | None = None,
        steps: int = 1,
        climb: int = 0,
        jitter: float = 0.0,
        max_depth: int | None = None,
        tries: int = 1000,
        known: Mapping[int, Any] | None = None,
        threads: int | None = None,
        watch: _Watch | None = None,
    ) -> Trajectories: ...
    @property
    def interrupted(self) -> bool: ...
    def choices(self, chain: int) -> list[tuple[str, str, str, int, int, int, bool]]: ...
    def fixed(self, chain: int) -> list[tuple[str, str, Any]]: ...
    def values(self, chain: int) -> NDArray[np.float64]: ...
    def positions(self, chain: int) -> NDArray[np.float64]: ...
    def draws(self, chain: int) -> dict[str, NDArray[Any]]: ...
    def scores(self, chain: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def counters(self, chain: int) -> dict[str, Any]: ...
    def fault(self, chain: int) -> BaseException | None: ...
    def outcome(self, chain: int, draw: int) -> Outcome: ...

@final
class Density:
    @property
    def dim(self) -> int: ...
    @property
    def start(self) -> NDArray[np.float64]: ...
    @property
    def choices(self) -> list[tuple[str, str, str, int, int]]: ...
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
class Outcome:
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
    def choices(self) -> list[tuple[int, Any]]: ...
    def order(self) -> list[tuple[int, int]]: ...

@final
class Trace:
    @property
    def choices(self) -> list[tuple[str, int, str, Any, float]]: ...
    @property
    def parts(self) -> list[tuple[str, list[Shape]]]: ...
    @property
    def queries(self) -> dict[Any, Any]: ...
    @property
    def value(self) -> Any: ...
    @property
    def log_prior(self) -> float: ...
    @property
    def log_score(self) -> float: ...
    @property
    def primitives(self) -> int: ...
    @property
    def similarity(self) -> float | None: ...
    @property
    def cause(self) -> str | None: ...

@final
class Opaque: ...

def unique_models(outcomes: Sequence[Outcome]) -> int: ...
def different(outcomes: Sequence[Outcome], k: int) -> list[int]: ...
