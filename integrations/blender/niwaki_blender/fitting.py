"""A fit under way: the sockets of a modifier, searched point by point in the Blender that runs.

The modifier is not known here: a function gives the mesh of some values. No step takes longer than one evaluation, so
Blender stays responsive.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import Any

import niwaki as nw
from niwaki.errors import InputError, NiwakiError
from niwaki.fitting.entry import ALL_FAILED, BATCH
from niwaki.fitting.in_blender.sockets import NodeTreeError, Socket
from niwaki.fitting.meshes import mesh_of
from niwaki.fitting.node_ranges import parameters_of, usual_range
from niwaki.targets import asks
from niwaki.targets.fit import Fit

from . import axes
from .order import Mesh

#: Values of sockets by their keys.
Values = dict[str, Any]


class RemovedError(Exception):
    """The object, its modifier or its node tree is gone: the search ends."""


@dataclass(frozen=True)
class Fitted:
    """One answer of a fit.

    Attributes
    ----------
    values : dict
        The values of the sockets that it uses, by their keys.
    named : dict
        The same by the sockets' names.
    log_score : float
        The log score, nats.
    covered, outside : float or None
        The covered share of the target; the share of the mesh outside of it.
    """

    values: Values
    named: dict[str, Any]
    log_score: float
    covered: float | None
    outside: float | None


class Fitting:
    """A fit under way.

    Parameters
    ----------
    rows
        The sockets of the modifier.
    held
        Keys of sockets that keep their values.
    goals
        Options of `niwaki.targets.asks`, in scene units from the world's origin.
    evaluate
        Returns the mesh of values by keys, vertices in Blender's world and triangles; raises `ValueError` for a mesh
        that there is not, and `RemovedError`.
    evaluations, seed
        The number of evaluations, and the seed.

    Attributes
    ----------
    best : order.Mesh or None
        The mesh of the best answer so far.
    problem : str
        The reason of a failure.
    interrupted : bool
        Whether the search was stopped before its end.
    """

    def __init__(
        self,
        rows: Sequence[Socket],
        held: Collection[str],
        goals: Mapping[str, Any],
        evaluate: Callable[[Values], Any],
        evaluations: int = 300,
        seed: int = 1,
    ) -> None:
        self._rows, self._evaluate, self.evaluations = list(rows), evaluate, evaluations
        free = {row.name: usual_range(row) for row in rows if row.is_used and row.key not in held}
        ranges = {name: range_ for name, range_ in free.items() if range_ is not None}
        parameters = parameters_of(rows, ranges, {})
        if not parameters:
            text = "all sockets are held" if free or held else "the mesh depends on none of its sockets"
            raise NodeTreeError(f"There is nothing to fit, {text}", "free one, or link it in the node tree")
        self.loop = nw.FitLoop(parameters, goal_of(goals), seed)
        self.best: Mesh | None = None
        self.problem = ""
        self.interrupted = self._has_ended = False
        self._best_score = -inf
        self._waiting: list[Any] = []

    @property
    def done(self) -> int:
        """The number of evaluations so far."""
        return self.loop.evaluated

    @property
    def has_ended(self) -> bool:
        """Whether the search has ended."""
        return self._has_ended

    def stop(self) -> None:
        """End the search, and keep its answers."""
        self.interrupted = self.interrupted or not self._has_ended
        self._has_ended = True

    def work(self, seconds: float) -> None:
        """Evaluate points until the seconds are over, at least one point."""
        end = time.monotonic() + seconds
        while not self._has_ended:
            self._step()
            if time.monotonic() >= end:
                break

    def answers(self, count: int) -> list[Fitted]:
        """Return the best answer, and others that differ."""
        if self._best_score == -inf:
            return []
        keys = {row.name: row.key for row in self._rows}
        return [
            Fitted(
                {keys[name]: value for name, value in answer.parameters.items()},
                dict(answer.parameters),
                answer.log_score,
                answer.covered,
                answer.outside,
            )
            for answer in self.loop.answers.variants(count)
        ]

    def progress(self) -> str:
        """Describe the progress for the panel."""
        text = f"{self.done} of {self.evaluations}"
        if self._best_score == -inf:
            return text
        best = self.loop.best
        if best.covered is None:
            return f"{text}, best {best.log_score:.2f}"
        return f"{text}, {Fit(best.covered, best.outside or 0.0)}"

    def _step(self) -> None:
        if not self._waiting:
            if self.done >= self.evaluations or not (
                points := self.loop.ask(min(BATCH, self.evaluations - self.done))
            ):
                self._has_ended = True
                return
            self._waiting = points[::-1]
        point = self._waiting.pop()
        keys = {row.name: row.key for row in self._rows}
        try:
            vertices, faces = self._evaluate({keys[name]: value for name, value in point.parameters.items()})
            points, corners = mesh_of((axes.to_scene(vertices), faces))
            outcome = self.loop.tell(point, (points, corners))
        except RemovedError as error:
            self.problem, self._has_ended = str(error), True
            return
        except (ValueError, NiwakiError) as error:
            outcome = self.loop.tell(point, nw.Failure(str(error).splitlines()[0]))
        if not isinstance(outcome, nw.Failure) and outcome.score > self._best_score:
            self._best_score, self.best = outcome.score, Mesh("best so far", vertices, faces)
        first = self.loop.outcomes[:ALL_FAILED]
        if len(first) == ALL_FAILED and all(isinstance(entry, nw.Failure) for entry in first):
            self.problem, self._has_ended = (
                f"The first {ALL_FAILED} evaluations failed: {first[0].text}",
                True,
            )


def goal_of(goals: Mapping[str, Any]) -> nw.Score:
    """Return the score of goals.

    Raises
    ------
    ValueError
        There is neither a target nor a picture.
    """
    try:
        terms = asks.sketches_of(goals, name="the modifier")
    except InputError as error:
        if error.code != "no-target":
            raise
        raise ValueError("Choose a target mesh, or a camera with a silhouette") from None
    # One mesh is one part, which intersects nothing.
    return asks.score([term for term in terms if term[0] != "no_self_intersection"])
