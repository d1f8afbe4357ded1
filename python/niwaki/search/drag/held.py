"""Parts that are held by a point: the run, the point, the movable choices, and the place of the point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.settings import bad
from niwaki.lang import lookup
from niwaki.lang.compiled import translated
from niwaki.once import cached_property
from niwaki.result import Sample, parts
from niwaki.result.search_like import SearchLike
from niwaki.targets.sketches import Score

Vector = NDArray[np.float64]
Point = Sequence[float]


@dataclass(frozen=True)
class Grip:
    """Point that is fixed to a shape of a part: a sum of the shape's directions, and a fixed offset."""

    shape: int
    shares: tuple[float, float, float]
    offset: Vector

    def at(self, frame: Vector) -> Vector:
        """The place of the point, for the middle and the directions of the shape, (4, 3)."""
        return np.asarray(frame[0] + np.asarray(self.shares) @ frame[1:] + self.offset)


@dataclass
class State:
    """Run with moved choices."""

    trace: _engine.Trace
    placer: _engine.Placer
    #: The address of the held part in the run.
    part: str
    values: dict[int, float] = field(default_factory=dict)
    #: The distance to the goal, scene units.
    error: float = inf
    #: Whether the run makes other choices than the run at the start of the drag.
    is_other: bool = False

    @property
    def choices(self) -> dict[str, Any]:
        """The moved choices, by readable address."""
        return {c.path: self.values.get(c.address, c.value) for c in self.trace.choices}


@dataclass
class Place:
    """Numbers of a descent: the movable choices, their ranges, and the derivatives of the point."""

    movables: list[tuple[int, str, bool]]
    #: Value, bounds and deviation of each, (n, 4).
    ranges: Vector
    #: The point, and its derivatives, (3,) and (3, n).
    point: Vector
    slopes: Vector

    @property
    def reach(self) -> dict[str, float]:
        """The distance by which each choice moves the point when it changes by its deviation, scene units."""
        far = np.linalg.norm(self.slopes, axis=0) * self.ranges[:, 3]
        return {name: float(d) for (_, name, _), d in zip(self.movables, far, strict=True)}


class Held:
    """A part that is held by a point of it: see `Sample.drag` for the parameters."""

    def __init__(
        self,
        search: SearchLike,
        sample: Sample,
        part: str,
        *,
        grab: Point | None = None,
        along: Point | None = None,
        hold: parts.Hold = (),
        to: Point | None = None,
    ) -> None:
        self.search, self.sample = search, sample
        if not sample.has_ended:
            raise bad("sample", sample, "a run that has ended", "more time or particles")
        # Descents do not score the scene, and know by themselves what is held.
        bare = replace(search, score=Score(), choices=None, polish=None, hold=None)
        with translated(search.model.name):
            self.task = bare.task
            trace = self.task.replay(dict(sample.choices), None)
            self.start = State(trace, self.task.placer(trace.run), "")
        scene = [address for address, _ in trace.parts]
        if not scene:
            raise InputError("no-address", pattern=part, name=search.model.name, nearest="there is no part")
        boxes = np.array([shape.aabb() for _, shapes in trace.parts for shape in shapes])
        self.size = float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max()) or 1.0
        kept = sample._held(hold)
        for address, value in kept.items():
            # A word may be given by its place, as in files that have no words.
            if value not in (sample.choices.get(address), sample.places.get(address)):
                actual = sample.choices.get(address, "no such choice")
                raise bad(
                    "hold", {address: value}, f"the value of the run, {actual!r}", "`sample.held(pattern)`"
                )
        self.holds = {*kept, *search.held}
        self.across = _projection(along)
        self.values = {choice.path: choice.value for choice in trace.choices}
        self._grips = self._gripped(part, grab)
        self.grip = self._grip(
            None if grab is None else point_of("grab", grab), None if to is None else point_of("to", to)
        )

    def _gripped(self, part: str, grab: Point | None) -> list[tuple[int, int, Vector, Any]]:
        """The shapes of the part, of a cut its solids: place, number, middle and directions, and the shape."""
        trace = self.start.trace
        scene = [address for address, _ in trace.parts]
        numbers = {n for n, address in enumerate(scene) if _engine.matches(part, address)}
        if not numbers:
            choices = [choice.path for choice in trace.choices if choice.family != "delta"]
            calls = parts.matching_parts(part, choices, scene, self.search.model)
            numbers = {n for n, place in enumerate(scene) if any(place.startswith(f"{c}/") for c in calls)}
        if not numbers:
            near = lookup.nearest(self.search.model.labels, part, scene, "part")
            raise InputError("no-address", pattern=part, name=self.search.model.name, nearest=near)
        free = {choice.address for choice in trace.choices}
        # A part whose choices are held is placed, too; the reason then names the held choices.
        self.all = self.start.placer.positions({}, free)
        spreads = np.maximum(self.all.ranges()[:, 3], 1e-12).tolist()
        self.spreads = {
            movable[1]: spread for movable, spread in zip(self.all.movables, spreads, strict=True)
        }
        grips: list[tuple[int, int, Vector, Any]] = []
        self._bases: set[tuple[int, int]] = set()
        for n in sorted(numbers):
            solids = [
                (shape, place) for whole in trace.parts[n][1] for place, shape in enumerate(whole.leaves())
            ]
            for k, (shape, place) in enumerate(solids):
                if place == 0:
                    self._bases.add((n, k))
                frame = self.all.frame(n, k)
                low, high = (np.array(corner) for corner in shape.aabb())
                middle = np.vstack([(low + high) / 2, np.zeros((3, 3))]) if frame is None else frame
                grips.append((n, k, middle, shape))
        return grips

    def _grip(self, grab: Vector | None, to: Vector | None) -> Grip:
        """Find the held point.

        The point is `grab`, fixed to the nearest shape; the default is the middle of the shape that is nearest to `to`.
        A cut is held by its first solid, unless `grab` is a point of another, such as a hole.
        """
        goal = to if grab is None else grab
        held = [grip for grip in self._grips if grab is not None or grip[:2] in self._bases]

        def order(grip: tuple[int, int, Vector, Any]) -> tuple[float, bool]:
            low, high = (np.array(corner) for corner in grip[3].aabb())
            distance = 0.0 if goal is None else float(np.linalg.norm(np.clip(goal, low, high) - goal))
            return distance, grip[:2] in self._bases

        self.at, shape, frame, _ = min(held, key=order)
        self.start.part = self.start.trace.parts[self.at][0]
        if grab is None:
            return Grip(shape, (0.0, 0.0, 0.0), np.zeros(3))
        shares = np.linalg.lstsq(frame[1:].T, grab - frame[0], rcond=1e-9)[0]
        offset = grab - frame[0] - shares @ frame[1:]
        return Grip(shape, triple(shares), offset)

    def movable(self, state: State) -> set[int]:
        """The choices that may move: all that are not held."""
        return {choice.address for choice in state.trace.choices if choice.path not in self.holds}

    def place(self, state: State, free: set[int]) -> Place | None:
        """The point and its derivatives; None if no choice moves it."""
        positions = state.placer.positions(state.values, free)
        number = next((n for n, (address, _) in enumerate(positions.parts) if address == state.part), None)
        if number is None or self.grip.shape >= positions.parts[number][1]:
            return None
        frame = positions.frame(number, self.grip.shape)
        if frame is None:
            return None
        slopes = positions.slopes(number, self.grip.shape, self.grip.shares)
        assert slopes is not None
        return Place(positions.movables, positions.ranges(), self.grip.at(frame), slopes)

    def whole(self, state: State) -> Place | None:
        """The point and its derivatives by all movable choices; None if no choice moves it."""
        return self.place(state, self.movable(state))

    def left(self, goal: Vector, point: Vector) -> float:
        """The distance from a point to the goal, scene units."""
        return float(np.linalg.norm(self.across @ (goal - point)))

    def movers(self, place: Place) -> set[str]:
        """The choices that move the point."""
        return {name for name, far in place.reach.items() if far > 1e-9 * self.size}

    @cached_property
    def start_place(self) -> Place | None:
        """The point at the start of the drag, with its derivatives by all movable choices."""
        return self.whole(self.start)

    @property
    def middle(self) -> Vector:
        """The middle of the held shape at the start of the drag."""
        return next(frame[0] for n, k, frame, _ in self._grips if (n, k) == (self.at, self.grip.shape))

    def replayed(self, task: _engine.Task, state: State, seed: int | None = None) -> _engine.Trace:
        """Replay a run with the moved choices; other choices are drawn from the seed."""
        return task.replay(state.choices, seed)


def point_of(name: str, value: Point) -> Vector:
    """Read a point of two or three numbers."""
    point = np.array(value, dtype=np.float64)
    if point.shape == (2,):
        point = np.append(point, 0.0)
    if point.shape != (3,) or not np.isfinite(point).all():
        raise bad(name, value, "a point of two or three finite numbers", "(1.0, 2.0, 0.0)")
    return point


def triple(point: Vector) -> tuple[float, float, float]:
    """Convert a point to a tuple."""
    x, y, z = point.tolist()
    return x, y, z


def _projection(along: Point | None) -> Vector:
    """The projection along a direction in which distances do not count."""
    if along is None:
        return np.eye(3)
    direction = point_of("along", along)
    norm = float(np.linalg.norm(direction))
    if norm == 0.0:
        raise bad("along", along, "a direction", "(0.0, 0.0, 1.0)")
    return np.asarray(np.eye(3) - np.outer(direction, direction) / norm**2)
