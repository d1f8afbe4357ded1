"""The loop of a fit: `ask` for points, evaluate them anywhere, and `tell` what came of them.

    loop = nw.FitLoop({"width": nw.Uniform(20, 80), "holes": nw.DiscreteUniform(0, 6)}, nw.match_volume("bracket.stl"))
    while loop.evaluated < 300:
        for point in loop.ask():
            loop.tell(point, bracket(**point.parameters))
    loop.best.parameters

Which point comes next depends on the outcomes of earlier points in the order of asking, never on when they were told.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from niwaki import _engine
from niwaki.errors.settings import bad, count
from niwaki.fitting.answers import Answer, Answers
from niwaki.fitting.goals import Goal, Outcome, scene_of
from niwaki.search.space import Space
from niwaki.targets.sketches import Score


@dataclass(frozen=True)
class Failure:
    """An evaluation that failed: no scene, and its point is impossible.

    Attributes
    ----------
    text : str
        What happened, for the table.
    """

    text: str


@dataclass(frozen=True)
class Point:
    """A point to evaluate.

    Attributes
    ----------
    number : int
        Its place in the order of asking, from 0.
    parameters : dict
        The values of the parameters that it uses, by name.
    row, used : tuple
        The point in the unit cube, and which parameters are used.
    """

    number: int
    parameters: dict[str, Any]
    row: tuple[float, ...] = ()
    used: tuple[bool, ...] = ()


class FitLoop:
    """A search for the parameters of a model whose evaluation is somebody else's.

    Parameters
    ----------
    parameters
        The parameters by name: see `Space`.
    goal
        A score such as `match_volume(target)`, a number, or a product of these.
    seed
        The seed of the search.

    Attributes
    ----------
    space : Space
    goal : Goal
    points : list of Point
        The points that were asked for, in order.
    outcomes : list of Outcome or Failure
        What came of them, as far as all earlier ones are told.
    """

    def __init__(self, parameters: Space | Mapping[str, Any], goal: Goal | Score, seed: int = 0) -> None:
        self.space, self.goal, self.seed = Space.of(parameters), Goal.of(goal), count("seed", seed, 0)
        self.proposer = _engine.Proposer(json.dumps(self.space.data()), self.seed)
        self.points: list[Point] = []
        self.outcomes: list[Outcome | Failure] = []
        self._early: dict[int, Outcome | Failure] = {}
        self._used: dict[int, list[bool]] = {}
        self._answers: tuple[int, Answers] | None = None

    @property
    def evaluated(self) -> int:
        """The number of points that are told, with all points before them."""
        return len(self.outcomes)

    @property
    def pending(self) -> list[Point]:
        """The points that were asked for and are not told yet."""
        return [point for point in self.points[self.evaluated :] if point.number not in self._early]

    def ask(self, count: int = 1) -> list[Point]:
        """Return the next points.

        Fewer points come back when the next one depends on the outcome of a pending point; none at all, when nothing
        can be proposed before that. Without pending points there is none only when all points of the space are known.

        Parameters
        ----------
        count
            The most points to return.
        """
        out: list[Point] = []
        while len(out) < count:
            proposed = self.proposer.ask()
            if proposed is None:
                break
            row, used = tuple(proposed[0]), tuple(proposed[1])
            out.append(Point(len(self.points), self.space.values(row, used), row, used))
            self.points.append(out[-1])
        return out

    def tell(
        self,
        point: Point | int,
        scene: Any,
        numbers: Mapping[str, float] | None = None,
        used: Collection[str] | None = None,
    ) -> Outcome | Failure:
        """Store what came of a point.

        Parameters
        ----------
        point
            The point, or its number.
        scene
            A scene, shapes, a mesh or a pair (vertices, faces); an `Outcome` that was measured elsewhere; a `Failure`.
        numbers
            Numbers that the goal scores and the scene does not show, by name.
        used
            The names of the parameters that the evaluation used, for models without known conditions: the search
            learns when each of them is used. None: those of the point.

        Returns
        -------
        Outcome or Failure
            What is stored.
        """
        number = point.number if isinstance(point, Point) else point
        if not 0 <= number < len(self.points) or number < self.evaluated or number in self._early:
            raise bad(
                "point", number, "the number of a pending point", "a point of `ask` that is not told yet"
            )
        for name in used or ():
            self.space.axis(name)
        outcome = (
            scene if isinstance(scene, (Outcome, Failure)) else self.goal.measure(scene_of(scene), numbers)
        )
        self._early[number] = outcome
        if used is not None:
            self._used[number] = [name in used for name in self.space.names]
        while self.evaluated in self._early:
            self._push(self._early.pop(self.evaluated))
        return outcome

    @property
    def answers(self) -> Answers:
        """The answers of the evaluations so far."""
        if self._answers is None or self._answers[0] != self.evaluated:
            self._answers = (self.evaluated, Answers(self))
        return self._answers[1]

    @property
    def best(self) -> Answer:
        """The evaluation with the highest score; the earlier one of two equal ones."""
        return self.answers.best

    def _push(self, outcome: Outcome | Failure) -> None:
        used = self._used.pop(self.evaluated, None)
        self.outcomes.append(outcome)
        if isinstance(outcome, Failure):
            self.proposer.tell(float("-inf"), None, used)
        else:
            self.proposer.tell(outcome.score, outcome.features, used)
