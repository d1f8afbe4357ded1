"""Discrete choices that decide the part, such as for one more branch or one segment less."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import inf
from typing import Any

from niwaki import _engine
from niwaki.result import parts
from niwaki.search.drag.descent import descend
from niwaki.search.drag.held import Held, State, Vector

#: The most values that are tried, and the most descents that begin from them.
TRIED, DESCENTS = 32, 6


def structures(held: Held, goal: Vector) -> list[State]:
    """Descend from runs with another value of one discrete choice that decides the part."""
    starts: list[tuple[float, State]] = []
    for name, value in _tried(held):
        try:
            other = held.task.replay({**held.values, name: value}, held.search.seed)
        except _engine.EngineFault:
            continue
        if other.run.log_prior > -inf:
            starts += _near(held, goal, State(other, held.task.placer(other.run), "", is_other=True))
    starts.sort(key=lambda start: start[0])
    states = []
    for _, state in starts[:DESCENTS]:
        here = held.whole(state)
        if here is None:
            continue
        if names := held.movers(here):
            states.append(descend(held, goal, state, names))
        else:
            states.append(replace(state, error=held.left(goal, here.point)))
    return states


def _tried(held: Held) -> list[tuple[str, Any]]:
    """Choices with other values; choices that a run makes last come first."""
    call = held.start.part.rpartition("/")[0]
    deciding = {*parts.deciding(call), call}
    choices = [c for c in held.start.trace.choices if c.path.rpartition("/")[0] in deciding]
    free = [choice for choice in reversed(choices) if choice.path not in held.holds]
    return [(choice.path, value) for choice in free for value in _alternatives(choice)][:TRIED]


def _near(held: Held, goal: Vector, state: State) -> list[tuple[float, State]]:
    """States of the part in another run, and of its siblings in loops, with their distances."""
    part, states = held.start.part, []
    for address in sorted({part, *_siblings(part)} & {place for place, _ in state.trace.parts}):
        there = replace(state, part=address)
        here = held.whole(there)
        if here is not None:
            states.append((held.left(goal, here.point), there))
    return states


def _alternatives(choice: _engine.Choice) -> list[Any]:
    """Other values of a discrete choice, near ones first; outside of its support a run is impossible."""
    if isinstance(choice.value, bool):
        return [not choice.value]
    if (words := choice.words) is not None:
        here = words.index(choice.value) if choice.value in words else 0
        places = sorted(range(len(words)), key=lambda place: abs(place - here))
        return [words[place] for place in places if words[place] != choice.value]
    if not isinstance(choice.value, int):
        return []
    reach = 5 if choice.family == "categorical" else 2
    return [choice.value + by for n in range(1, reach + 1) for by in (n, -n) if choice.value + by >= 0]


def _siblings(part: str) -> Iterable[str]:
    """The corresponding parts of the next and the previous iteration of each loop around a part."""
    at = part.find("]")
    while at >= 0:
        begin = part.rfind("[", 0, at)
        number = part[begin + 1 : at]
        if number.isdigit():
            yield from (
                f"{part[: begin + 1]}{int(number) + by}{part[at:]}" for by in (1, -1) if int(number) + by >= 0
            )
        at = part.find("]", at + 1)
