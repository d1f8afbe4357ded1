"""`nw.FitLoop` on a problem: the search that `nw.fit` runs, in this process."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import niwaki as nw
from niwaki.targets.pieces import joined
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Uniform

from .parameters import Parameter, Values, canonical
from .problems import IMPOSSIBLE, Problem


def search(problem: Problem, seed: int) -> None:
    """Search until all evaluations are spent."""
    loop = nw.FitLoop(ranges(problem.parameters), problem.goal, seed)
    while problem.count < problem.budget:
        for point in loop.ask(8):
            if problem.count < problem.budget:
                tell(problem, loop, point)
    problem.finish()


def tell(problem: Problem, loop: nw.FitLoop, point: nw.fitting.Point) -> None:
    """Evaluate a point; the score and the features are taken from one measure of the mesh."""
    values: Values = {row.name: point.parameters.get(row.name, row.unused) for row in problem.parameters}
    _, values = canonical(problem.parameters, values)
    with problem.inside():
        try:
            outcome = loop.goal.measure(nw.fitting.goals.scene_of(joined(problem.generator.parts(values))))
        except ValueError as error:
            outcome = nw.Failure(str(error))
    score = outcome.score if isinstance(outcome, nw.fitting.Outcome) else IMPOSSIBLE
    problem.note(max(score, IMPOSSIBLE), values)
    loop.tell(point, outcome)


def ranges(parameters: Sequence[Parameter]) -> dict[str, nw.Parameter]:
    """The parameters with their conditions, as far as one earlier parameter decides them."""
    return {row.name: nw.Parameter(_range(row), condition(parameters, row)) for row in parameters}


def condition(rows: Sequence[Parameter], row: Parameter) -> list[dict[str, list[Any]]] | None:
    """The values of earlier parameters that decide whether a parameter is used; None without such values.

    The nearest parameter with values that never use it decides; else any of those whose values alone use it.
    """
    if row.when is None:
        return None
    before = rows[: [entry.name for entry in rows].index(row.name)]
    discrete = [entry for entry in before if entry.kind != "real"]
    low, high = ({entry.name: entry.levels[end] for entry in discrete} for end in (0, -1))
    for other in reversed(discrete):
        levels = [
            level
            for level in other.levels
            if any(row.when({**base, other.name: level}) for base in (low, high))
        ]
        if 0 < len(levels) < len(other.levels):
            return [{other.name: levels}]
    alone = [
        (other.name, [x for x in other.levels if row.when({**low, other.name: x})]) for other in discrete
    ]
    return [{name: levels} for name, levels in alone if levels] or None


def _range(row: Parameter) -> object:
    if row.kind == "real":
        return Uniform(*row.domain)
    if row.kind == "whole":
        return DiscreteUniform(*row.domain)
    return Bernoulli(0.5) if row.kind == "switch" else list(row.domain)
