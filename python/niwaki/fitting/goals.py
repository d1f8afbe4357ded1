"""Goals: what a scene is scored by, with the differences that an emulator learns.

    goal = Goal.of(match_volume(target) * number("volume", 3.0, tolerance=0.05))

A product of sketches is a goal. A number is a measure of the scene that should have a value: its volume, its height, or
what a function of the scene returns.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import inf, isfinite, log, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.errors.settings import bad, real, shown
from niwaki.targets.differences import Differences, differences, log_score
from niwaki.targets.fit import fit
from niwaki.targets.sketches import Score

#: A measure of a scene that has a name.
MEASURES = ("volume", "area", "width", "height", "depth")

#: Numbers further off than this many tolerances are all as wrong.
FARTHEST = 200.0


@dataclass(frozen=True)
class Number:
    """A number that should have a value.

    Attributes
    ----------
    name : str
        A measure of the scene, or the name under which the evaluation reports the number.
    value, tolerance : float
        The value, and the standard deviation of the number about it.
    measure : callable or None
        Computes the number from a scene.
    """

    name: str
    value: float
    tolerance: float
    measure: Callable[[Scene], float] | None = None

    def of(self, scene: Scene, reported: Mapping[str, float]) -> float:
        """Return the number of a scene."""
        if self.name in reported:
            return float(reported[self.name])
        if self.measure is not None:
            return float(self.measure(scene))
        if self.name in MEASURES:
            return measured(scene, self.name)
        raise bad(
            "numbers",
            dict(reported),
            f"a number `{self.name}`, which the goal scores",
            f"numbers with `{self.name}`, or name one of {', '.join(MEASURES)} in the goal",
        )


def number(
    measure: str | Callable[[Scene], float], value: float, tolerance: float, name: str | None = None
) -> Goal:
    """Score a number of a scene by its distance from a value, in units of a tolerance.

    Parameters
    ----------
    measure
        "volume", "area", "width" (along x), "height" (y) or "depth" (z) of the scene's mesh; the name of a number that
        the evaluation reports; or a function of the scene.
    value, tolerance
        The value that the number should have, and the standard deviation about it.
    name
        The name of a function's number in tables; by default the function's own.
    """
    real("value", value)
    real("tolerance", tolerance, 0)
    if isinstance(measure, str):
        return Goal(numbers=(Number(name or measure, float(value), float(tolerance)),))
    called = name or str(getattr(measure, "__name__", "number"))
    return Goal(numbers=(Number(called, float(value), float(tolerance), measure),))


@dataclass(frozen=True)
class Outcome:
    """An outcome of an evaluation: all that a search needs of it, small enough to be sent and stored.

    Attributes
    ----------
    score : float
        The log score, nats; minus infinity for a forbidden scene.
    features : (n,) float32
        The differences between the scene and its goal.
    covered, outside : float or None
        The fit to the first target: shares of the target and of the scene.
    numbers : dict
        Measures: those of the sketches, and the numbers of the goal.
    """

    score: float
    features: NDArray[np.float32]
    covered: float | None = None
    outside: float | None = None
    numbers: dict[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Goal:
    """A product of sketches and numbers.

    Attributes
    ----------
    score : Score
        The sketches.
    numbers : tuple of Number
        The numbers.
    parts : list of Differences
        The differences of the sketches that have some.
    without : tuple of str
        The sketches without differences, whose part of the score is predicted as one number or not at all.
    """

    score: Score = Score()  # noqa: RUF009
    numbers: tuple[Number, ...] = ()
    parts: list[Differences] = field(init=False, repr=False, compare=False)
    without: tuple[str, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        parts, without = differences(self.score)
        object.__setattr__(self, "parts", parts)
        object.__setattr__(self, "without", tuple(without))

    def __reduce__(self) -> Any:
        return Goal, (self.score, self.numbers)

    @classmethod
    def of(cls, goal: Goal | Score) -> Goal:
        """Return a goal, or make it from sketches."""
        if isinstance(goal, Goal):
            return goal
        if not isinstance(goal, Score):
            raise bad(
                "goal",
                goal,
                "a score such as `match_volume(target)`, or a product of scores and numbers",
                "one",
            )
        if not goal.asks:
            raise InputError("no-target", name="the model")
        return cls(goal)

    def __mul__(self, other: Goal | Score) -> Goal:
        if isinstance(other, Score):
            return Goal(self.score * other, self.numbers)
        if isinstance(other, Goal):
            return Goal(self.score * other.score, self.numbers + other.numbers)
        return NotImplemented

    def __rmul__(self, other: Score) -> Goal:
        return Goal(other * self.score, self.numbers) if isinstance(other, Score) else NotImplemented

    @property
    def has_features(self) -> bool:
        """Whether any sketch or number has differences."""
        return bool(self.parts) or bool(self.numbers)

    @property
    def sizes(self) -> list[int]:
        """The number of differences of each sketch that has some."""
        empty = Scene([])
        return [len(part([], empty)) for part in self.parts]

    def measure(self, scene: Scene, numbers: Mapping[str, float] | None = None) -> Outcome:
        """Score a scene.

        Parameters
        ----------
        scene
            The scene.
        numbers
            Numbers that the evaluation reports by name, for numbers of the goal.
        """
        score, measures = log_score(self.score, scene) if self.score.asks else (0.0, {})
        shapes = [shape for part in scene.parts for shape in part.shapes]
        parts = [part(shapes, scene) for part in self.parts]
        values: dict[str, float] = {}
        for wish in self.numbers:
            values[wish.name] = wish.of(scene, numbers or {})
            off = (values[wish.name] - wish.value) / wish.tolerance
            if not isfinite(off):
                off = FARTHEST
            score -= 0.5 * off * off + log(wish.tolerance) + 0.5 * log(2.0 * pi)
            parts.append(np.array([min(max(off, -FARTHEST), FARTHEST)]))
        vector = np.concatenate(parts) if parts else np.zeros(0)
        shares = fit(self.score, scene) if self.score.asks else None
        return Outcome(
            score if score == score else -inf,
            vector.astype(np.float32),
            None if shares is None else shares.covered,
            None if shares is None else shares.outside,
            {**measures, **values},
        )


def measured(scene: Scene, name: str) -> float:
    """Return a measure of a scene's mesh; parts that overlap count twice in its volume and area."""
    if name in ("width", "height", "depth"):
        low, high = scene.bounds
        return float((high - low)[("width", "height", "depth").index(name)])
    total = 0.0
    for part in scene.parts:
        for shape in part.shapes:
            corners = shape.vertices()[shape.faces()]
            cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            if name == "area":
                total += 0.5 * float(np.sqrt((cross**2).sum(1)).sum())
            else:
                total += abs(float((corners[:, 0] * cross).sum())) / 6.0
    return total


def scene_of(mesh: Any) -> Scene:
    """Return the scene of what an evaluation gave: a scene, a shape or shapes, a mesh, or vertices and faces.

    A mesh is an object with `vertices` and `faces`. None and a mesh without triangles are the empty scene.
    """
    if isinstance(mesh, Scene):
        return mesh
    if mesh is None:
        return Scene([])
    if isinstance(mesh, _engine.Shape):
        return Scene([("part", [mesh])])
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces") and not callable(mesh.vertices):
        mesh = (mesh.vertices, mesh.faces)
    if isinstance(mesh, (list, tuple)) and all(isinstance(item, _engine.Shape) for item in mesh):
        return Scene([("part", list(mesh))] if mesh else [])
    if isinstance(mesh, tuple) and len(mesh) == 2:
        vertices = np.ascontiguousarray(np.asarray(mesh[0], dtype=np.float64)).reshape(-1, 3)
        faces = np.ascontiguousarray(np.asarray(mesh[1], dtype=np.int64)).reshape(-1, 3)
        if not len(faces):
            return Scene([])
        return Scene([("part", [_engine.shape("mesh", vertices, faces)])])
    raise bad(
        "what the model returned",
        shown(mesh),
        "a scene, shapes, a mesh with `vertices` and `faces`, or a pair of these arrays",
        "a mesh",
    )
