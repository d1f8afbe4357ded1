"""A generator with hidden parameters: its target, the score of a mesh, and what a search has found so far."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import _engine
from niwaki.targets.pieces import joined

from . import candle, fresh, furniture, houses, machines
from .parameters import Parameter, Values, canonical, drawn
from .solids import Part, intersection_over_union, union

#: Numbers of evaluations after which the best so far is judged.
MARKS = (100, 300, 1000)

#: Nats below the score of the hidden parameters within which a problem is solved; for volumes this is 5.9 of 5.99.
NEAR = 0.085

#: Cells are so much larger than those of `match_volume` by default.
COARSER = 1.25

#: The log score of an impossible scene.
IMPOSSIBLE = -1e6


@dataclass(frozen=True)
class Generator:
    """A generator of closed parts, and the goal by which it is judged: "volume", "image" or "two images"."""

    name: str
    parameters: Sequence[Parameter]
    parts: Callable[[Values], list[Part]]
    goal: str = "volume"
    is_fresh: bool = False


GENERATORS = {
    row.name: row
    for row in (
        Generator("table", furniture.TABLE, furniture.table),
        Generator("shelf", furniture.SHELF, furniture.shelf),
        Generator("gear", machines.GEAR, machines.gear),
        Generator("chair", furniture.CHAIR, furniture.chair),
        Generator("stair", houses.STAIR, houses.stair),
        Generator("vase", houses.VASE, houses.vase),
        Generator("bracket", machines.BRACKET, machines.bracket),
        Generator("building", houses.BUILDING, houses.building),
        Generator("boat", fresh.BOAT, fresh.boat, is_fresh=True),
        Generator("lamp", fresh.LAMP, fresh.lamp, is_fresh=True),
        Generator("bridge", fresh.BRIDGE, fresh.bridge, is_fresh=True),
        Generator("relief", fresh.RELIEF, fresh.relief, is_fresh=True),
        Generator("can", fresh.CAN, fresh.can, goal="image", is_fresh=True),
        Generator("sculpture", fresh.SCULPTURE, fresh.sculpture, goal="two images", is_fresh=True),
        Generator("stones", fresh.STONES, fresh.stones, is_fresh=True),
        Generator("candle", candle.CANDLE, candle.candle, is_fresh=True),
    )
}


class Spent(Exception):
    """All evaluations of a search are spent."""


@dataclass
class Judged:
    """The best values after some evaluations, and seconds of the search alone until then."""

    score: float
    values: Values | None
    seconds: float


@dataclass
class Problem:
    """A generator with hidden parameters from a seed. `evaluate` is what a search sees; equal points count once.

    The vertices of a rough target are moved by normal draws of this standard deviation: no parameters reach it.
    """

    generator: Generator
    number: int
    budget: int
    rough: float = 0.0
    count: int = 0
    requests: int = 0
    best: float = -math.inf
    best_values: Values | None = None
    judged: dict[int, Judged] = field(default_factory=dict)

    def __post_init__(self) -> None:
        random = np.random.default_rng(1000 + self.number)
        self.hidden = drawn(self.generator.parameters, random)
        parts = self.generator.parts(self.hidden)
        self.solid = union(parts)
        self.goal = _goal(self.generator.goal, parts, self.solid, self.rough, random)
        self.truth = self.score(parts)
        self._cache: dict[tuple[Any, ...], float] = {}
        self._inside = 0.0
        self._started = time.perf_counter()

    @property
    def parameters(self) -> Sequence[Parameter]:
        return self.generator.parameters

    def score(self, parts: list[Part]) -> float:
        """The log score of a scene of one mesh."""
        sketch = _engine.Sketch(self.goal.specs)
        vertices, faces = joined(parts)
        if len(faces):
            sketch.add([_engine.shape("mesh", vertices, faces)])
        return max(sketch.log_score(), IMPOSSIBLE)

    def evaluate(self, raw: Mapping[str, Any]) -> float:
        """The log score of parameters; those that are not used are ignored."""
        self.requests += 1
        names, values = canonical(self.parameters, raw)
        key = tuple((name, values[name]) for name in names)
        if key in self._cache:
            if self.requests > 3 * self.budget:
                raise Spent
            return self._cache[key]
        if self.count >= self.budget:
            raise Spent
        with self.inside():
            try:
                score = self.score(self.generator.parts(values))
            except ValueError:
                score = IMPOSSIBLE
        self.note(score, values)
        self._cache[key] = score
        return score

    @contextmanager
    def inside(self) -> Iterator[None]:
        """Count the time of the block as that of an evaluation."""
        started = time.perf_counter()
        yield
        self._inside += time.perf_counter() - started

    def note(self, score: float, values: Values) -> None:
        """Count an evaluation, and keep the best."""
        self.count += 1
        if score > self.best:
            self.best, self.best_values = score, values
        if self.count in MARKS:
            self.mark(self.count)

    def mark(self, evaluations: int) -> None:
        outside = time.perf_counter() - self._started - self._inside
        self.judged[evaluations] = Judged(self.best, self.best_values, outside)

    def finish(self) -> None:
        """Judge the best by the marks that a search has not reached, if it proposed nothing new any more."""
        for evaluations in MARKS:
            if evaluations <= self.budget and evaluations not in self.judged:
                self.mark(evaluations)

    def measures(self, judged: Judged) -> dict[str, float | None]:
        """Score, IoU, share of exact discrete parameters, mean error of reals, whether it is solved."""
        if judged.values is None:
            return dict(score=judged.score, iou=0.0, switches=0.0, error=1.0, solved=0.0)
        names, hidden = canonical(self.parameters, self.hidden)
        exact, errors = [], []
        for parameter in self.parameters:
            if parameter.name not in names:
                continue
            value, truth = judged.values[parameter.name], hidden[parameter.name]
            if parameter.kind == "real":
                low, high = parameter.domain
                errors.append(1.0 if value is None else abs(value - truth) / (high - low))
            else:
                exact.append(value == truth)
        return dict(
            score=judged.score,
            iou=intersection_over_union(union(self.generator.parts(judged.values)), self.solid),
            switches=float(np.mean(exact)) if exact else None,
            error=float(np.mean(errors)) if errors else None,
            solved=float(judged.score >= self.truth - NEAR),
        )


def _goal(goal: str, parts: list[Part], solid: Any, rough: float, random: np.random.Generator) -> nw.Score:
    mesh = solid.to_mesh()
    vertices = np.asarray(mesh.vert_properties[:, :3], float)
    if rough:
        vertices = vertices + random.normal(0.0, rough, vertices.shape)
    target = nw.Target(vertices, np.asarray(mesh.tri_verts, np.int64), name="hidden")
    if goal == "volume":
        voxel = nw.match_volume(target).asks[0].arguments["voxel"]
        return nw.match_volume(target, COARSER * voxel)
    views = [(0.0, 0.0, 1.0)] if goal == "image" else [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)]
    score = nw.overshoot(target)
    for along in views:
        score = score * _image(target, parts, np.array(along))
    return score


def _image(target: nw.Target, parts: list[Part], along: Any) -> nw.Score:
    """The silhouette of a mesh, seen along a direction: an orthographic picture of 96 x 96 pixels with a margin."""
    low, high = target.bounds
    middle, size = (low + high) / 2, float((high - low).max())
    camera = nw.Camera.orthographic(middle + 3 * size * along, middle, height=1.6 * size)
    blank = np.zeros((96, 96), bool)
    blank[40:50, 40:50] = True
    view = nw.match_image(blank, camera).views[0].picture
    return nw.match_image(view.mask([_engine.shape("mesh", *joined(parts))]), camera)
