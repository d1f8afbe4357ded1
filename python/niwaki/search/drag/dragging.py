"""Answers of a drag to a point, the least change first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.lang.compiled import translated
from niwaki.result import Sample, parts
from niwaki.result.dragged import Drag, Dragged, Moved
from niwaki.result.search_like import SearchLike
from niwaki.search.drag.descent import bounds, descend
from niwaki.search.drag.held import Held, Place, Point, State, Vector, point_of, triple
from niwaki.search.drag.reasons import nothing_moves, too_far
from niwaki.search.drag.source import NEAR, SourceChange, explained
from niwaki.search.drag.structure import structures

#: Answers are equal if their choices differ by less than this, in deviations of the priors.
TOLERANCE = 0.05
#: Another structure counts as the nearest state only if its distance is at most this share of the others'.
WORTH = 0.8
#: The number of descents from other values if the first ones give no answer, and the distance of these values, in
#: deviations of the priors.
ELSEWHERE, AROUND = 6, 0.5


class Dragging(Held):
    """Drag of a part to one or many points: see `Sample.drag` for the parameters."""

    #: The choices at the last point of a moving pointer.
    _warm: Mapping[int, float] = {}

    def source(self, point: Point, most: int = 3) -> list[SourceChange]:
        """List changes of the model's file that take the part to a point, the least change first.

        A model without a file of the user, such as those of the gallery, has none.
        """
        return explained(self, point_of("to", point), most)

    def to(self, point: Point, *, answers: int = 4, structure: bool = True) -> Drag:
        """Drag the part to a point: see `Sample.drag`."""
        goal = point_of("to", point)
        with translated(self.search.model.name):
            return self._to(goal, answers, structure)

    def _to(self, goal: Vector, answers: int, structure: bool) -> Drag:
        place = self.start_place
        names = set[str]() if place is None else self.movers(place)
        if place is None or not names:
            states: list[tuple[str, State]] = []
        else:
            states = [
                (kind, descend(self, goal, self.start, some)) for kind, some in self._kinds(place, names)
            ]
        answered, forbidden = self._possible(states, answers)
        if states and not answered:
            fallbacks = [("other", state) for state in self._elsewhere(goal, names)]
            states += fallbacks
            answered, forbidden = self._possible(fallbacks, answers, forbidden)
        if structure and not answered:
            fallbacks = [("structure", state) for state in structures(self, goal)]
            states += fallbacks
            answered, forbidden = self._possible(fallbacks, answers, forbidden)
        if answered:
            return Drag(answered)
        there = [(kind, state) for kind, state in states if state.error <= NEAR * self.size]
        if there:
            near = self._scored(*there[0])
            return Drag([], near, f"the run is impossible with `{self.start.part}` at the point: {forbidden}")
        if not states:
            return Drag([], None, nothing_moves(self))
        # Another structure must be much nearer.
        kind, state = min(
            states, key=lambda entry: entry[1].error / (WORTH if entry[0] == "structure" else 1.0)
        )
        return Drag([], self._scored(kind, state), too_far(self, goal, state))

    def _possible(
        self, states: Sequence[tuple[str, State]], answers: int, forbidden: str = ""
    ) -> tuple[list[Dragged], str]:
        """Select different and possible states at the point, the least change first; or the cause against one."""
        answered: list[Dragged] = []
        looked_at: list[dict[str, Any]] = []
        there = [(kind, state) for kind, state in states if state.error <= NEAR * self.size]
        for kind, state in sorted(there, key=lambda entry: self._change(entry[1])):
            after = state.choices
            if len(answered) >= answers or any(self._is_same(after, other) for other in looked_at):
                continue
            looked_at.append(after)
            answer = self._scored(kind, state)
            if answer.sample.cause is None or self.sample.cause is not None:
                answered.append(answer)
            else:
                forbidden = forbidden or answer.sample.cause
        return answered, forbidden

    def _elsewhere(self, goal: Vector, names: set[str]) -> list[State]:
        """Descend from other values of the choices, drawn around those of the run by the seed of the search."""
        rng = np.random.default_rng(self.search.seed)
        first = self.start_place
        assert first is not None
        low, high = bounds(first.ranges)
        moving = np.array([name in names for _, name, _ in first.movables])
        states = []
        for _ in range(ELSEWHERE):
            drawn = first.ranges[:, 0] + rng.normal(size=len(moving)) * first.ranges[:, 3] * AROUND
            values = np.clip(drawn, low, high).tolist()
            warm = {
                number[0]: value
                for number, value, is_in in zip(first.movables, values, moving, strict=True)
                if is_in
            }
            # A run with these values may fail, or make other choices.
            with suppress(_engine.EngineFault):
                states.append(descend(self, goal, self.start, names, warm, is_near_warm=True))
        return states

    def move(self, point: Point) -> Moved:
        """Move the part with the least change, for a moving pointer: the descent starts at the last point."""
        goal = point_of("to", point)
        with translated(self.search.model.name):
            return self._move(goal)

    def _move(self, goal: Vector) -> Moved:
        place = self.start_place
        names = set() if place is None else self.movers(place)
        if place is None or not names:
            left = self.left(goal, self.middle) / self.size
            return Moved(Scene(self.start.trace.parts), triple(self.middle), left, nothing_moves(self))
        state = descend(self, goal, self.start, names, self._warm)
        self._warm = {} if state.is_other else state.values
        here = self.whole(state)
        assert here is not None
        reason = "" if state.error <= NEAR * self.size else too_far(self, goal, state)
        scene = Scene(self.replayed(self.task, state).parts)
        return Moved(scene, triple(here.point), state.error / self.size, reason)

    def _kinds(self, place: Place, names: set[str]) -> list[tuple[str, set[str]]]:
        """Sets of choices that may change: the ways in which an edit can be meant."""
        call = self.start.part.rpartition("/")[0]
        inner = {name for name in names if name.rpartition("/")[0] == call}
        outer = {name for name in names if "/" not in name}
        kinds = [("least", names), ("own", inner), ("outermost", outer)]
        reach = place.reach
        few = set(sorted(names, key=lambda name: -reach[name])[:3])
        kinds.append(("fewest", few))
        kept: list[tuple[str, set[str]]] = []
        for kind, some in kinds:
            if some and some not in [other for _, other in kept]:
                kept.append((kind, some))
        return kept

    def _change(self, state: State) -> float:
        """The sum of squares of the changes, in deviations; a changed structure comes after all others."""
        moved = [
            (value - self.values[name]) / self.spreads[name]
            for name, value in state.choices.items()
            if name in self.spreads
        ]
        return float(np.square(moved).sum()) + (1e6 if state.is_other else 0.0)

    def _is_same(self, choices: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
        """Whether two runs differ by little in all of their choices."""
        return choices.keys() == other.keys() and all(
            value == other[name]
            or (
                isinstance(value, float)
                and abs(value - other[name]) < TOLERANCE * self.spreads.get(name, 0.0)
            )
            for name, value in choices.items()
        )

    def _scored(self, kind: str, state: State) -> Dragged:
        trace = self.replayed(self.search.task, state)
        sample = Sample.of_trace(trace, self.search, self.sample.seed)
        after = sample.choices
        changed = {
            name: (self.values.get(name), after.get(name))
            for name in dict.fromkeys([*self.values, *after])
            if self.values.get(name) != after.get(name)
        }
        here = self.whole(state)
        movers = set() if here is None else self.movers(here)
        call = state.part.rpartition("/")[0]
        deciding = {*parts.deciding(call), call}
        free = {choice.path for choice in sample._trace.choices if choice.family != "delta"}
        holds = {
            name: value
            for name, value in after.items()
            if name in free and (name in movers or name.rpartition("/")[0] in deciding)
        }
        return Dragged(sample, changed, state.error, state.error / self.size, kind, state.part, holds)


def dragged(
    search: SearchLike,
    sample: Sample,
    part: str,
    to: Point,
    *,
    grab: Point | None = None,
    along: Point | None = None,
    hold: parts.Hold = (),
    answers: int = 4,
    structure: bool = True,
) -> Drag:
    """Drag a part of a sample of this search: see `Sample.drag`."""
    return Dragging(search, sample, part, grab=grab, along=along, hold=hold, to=to).to(
        to, answers=answers, structure=structure
    )
