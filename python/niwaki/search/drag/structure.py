"""Discrete choices that decide the part: a branch more, a segment less."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import inf
from typing import Any

from niwaki import _engine
from niwaki.result import parts
from niwaki.search.drag.descent import descend
from niwaki.search.drag.held import Held, State, Vector

#: Values that are tried, and those of them from which a descent begins.
TRIED, BEGUN = 32, 6


def structures(held: Held, goal: Vector) -> list[State]:
    """Runs with another value of one discrete choice that decides the part, each moved to the point."""
    begun: list[tuple[float, State]] = []
    for name, value in _tried(held):
        try:
            other = held.task.replay({**held.values, name: value}, held.search.seed)
        except _engine.EngineFault:
            continue
        if other.run.log_prior > -inf:
            begun += _near(held, goal, State(other, held.task.placer(other.run), "", is_other=True))
    begun.sort(key=lambda one: one[0])
    found = []
    for _, state in begun[:BEGUN]:
        here = held.whole(state)
        if here is not None:
            found.append(descend(held, goal, state, held.movers(here)))
    return found


def _tried(held: Held) -> list[tuple[str, Any]]:
    """Choices with other values: those first that are made last."""
    call = held.start.part.rpartition("/")[0]
    deciding = {*parts.deciding(call), call}
    choices = [c for c in held.start.trace.choices if c.path.rpartition("/")[0] in deciding]
    free = [choice for choice in reversed(choices) if choice.path not in held.holds]
    return [(choice.path, value) for choice in free for value in _others(choice)][:TRIED]


def _near(held: Held, goal: Vector, state: State) -> list[tuple[float, State]]:
    """The part in another run, by its address, and how far it is; with those that take its place in its loops."""
    part, found = held.start.part, []
    for one in sorted({part, *_siblings(part)} & {address for address, _ in state.trace.parts}):
        there = replace(state, part=one)
        here = held.whole(there)
        if here is not None:
            found.append((held.left(goal, here.point), there))
    return found


def _others(choice: _engine.Choice) -> list[Any]:
    """Other values of a discrete choice, those that are near first; outside of its support a run is impossible."""
    if isinstance(choice.value, bool):
        return [not choice.value]
    if not isinstance(choice.value, int):
        return []
    reach = 5 if choice.family == "categorical" else 2
    return [choice.value + by for n in range(1, reach + 1) for by in (n, -n) if choice.value + by >= 0]


def _siblings(part: str) -> Iterable[str]:
    """The same part of the next and of the last iteration of each loop that it is in."""
    at = part.find("]")
    while at >= 0:
        begin = part.rfind("[", 0, at)
        number = part[begin + 1 : at]
        if number.isdigit():
            yield from (
                f"{part[: begin + 1]}{int(number) + by}{part[at:]}" for by in (1, -1) if int(number) + by >= 0
            )
        at = part.find("]", at + 1)
