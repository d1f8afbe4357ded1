"""Real choices moved until the point is there, or no step brings it nearer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf, pi, tau

import numpy as np

from niwaki import _engine
from niwaki.search.drag.held import Held, State, Vector

#: A descent ends when what is left is this share of the scene's size.
DONE = 1e-4
#: Steps of a descent at most, and the longest first one, in deviations of the priors.
STEPS, REACH = 24, 1.5
#: Descents that have come no nearer by this share in so many steps end.
STALLED, PATIENCE = 0.02, 4
#: So often a descent may enter another branch of the model.
BRANCHES = 3
#: A number stays this share of its range away from an end that is no value.
MARGIN = 1e-6


def descend(
    held: Held,
    goal: Vector,
    start: State,
    names: set[str],
    warm: Mapping[int, float] | None = None,
    branches: int = BRANCHES,
    is_near_warm: bool = False,
) -> State:
    """Move these choices until the point is there, or no step brings it nearer.

    Where a step leads into another branch of the model, the descent goes on from the run there. The change is least
    from the start; `is_near_warm`: from where the descent begins.
    """
    free = {choice.address for choice in start.trace.choices if choice.path in names}
    state = replace(start, values=dict(start.values), error=inf)
    origin = start.values
    first = held.place(state, free)
    here = held.place(replace(state, values={**origin, **warm}), free) if warm else first
    if here is None or first is None:
        return state
    zero, spread = first.ranges[:, 0], np.maximum(first.ranges[:, 3], 1e-12)
    low, high = bounds(first.ranges)
    low, high = (low - zero) / spread, (high - zero) / spread
    z = (here.ranges[:, 0] - zero) / spread
    center = z if is_near_warm else np.zeros(len(z))
    error = held.left(goal, here.point)
    reach, damping, errors = REACH, 1e-4, [error]
    for _ in range(STEPS):
        if error <= DONE * held.size or reach < 1e-6:
            break
        rows = held.across @ here.slopes * spread
        left = held.across @ (goal - here.point) + rows @ (z - center)
        aim = center + least(rows, left, damping, low - center, high - center)
        step = aim - z
        longest = float(np.abs(step).max(initial=0.0))
        if longest > reach:
            step *= reach / longest
        tried = np.clip(z + step, low, high)
        values = {
            address: wrapped(x) if is_angle else x
            for (address, _, is_angle), x in zip(here.movables, (zero + spread * tried).tolist(), strict=True)
        }
        try:
            there = held.place(replace(state, values={**origin, **values}), free)
        except _engine.EngineFault:
            # The run fails there, or makes other choices.
            there = None
        is_other = there is None or [one[0] for one in there.movables] != [one[0] for one in here.movables]
        if is_other and branches > 0:
            other = _branched(held, goal, replace(state, values={**origin, **values}), names, branches, error)
            if other is not None:
                return other
        nearer = inf if there is None else held.left(goal, there.point)
        if there is not None and not is_other and nearer < error:
            z, here, error = tried, there, nearer
            state.values = {**origin, **values}
            reach, damping = min(2 * reach, REACH), max(damping / 10, 1e-9)
            errors.append(error)
            if len(errors) > PATIENCE and errors[-1] > (1 - STALLED) * errors[-1 - PATIENCE]:
                break
        else:
            reach, damping = min(reach, longest) / 4, min(damping * 10, 1.0)
    if error == errors[0] and warm:
        state.values = {**origin, **warm}
    state.error = error
    return state


def _branched(
    held: Held, goal: Vector, state: State, names: set[str], branches: int, error: float
) -> State | None:
    """The descent from a run with other choices, where the part is nearer in it; missing ones are drawn."""
    try:
        trace = held.replayed(held.task, state, held.search.seed)
    except _engine.EngineFault:
        return None
    other = State(trace, held.task.placer(trace.run), state.part, is_other=True)
    here = held.whole(other)
    if here is None or held.left(goal, here.point) >= error:
        return None
    known = {choice.path for choice in state.trace.choices}
    free = {name for name in held.movers(here) if name in names or name not in known}
    return descend(held, goal, other, free, branches=branches - 1)


def bounds(ranges: Vector) -> tuple[Vector, Vector]:
    """The ends between which values stay, within those of their ranges."""
    is_between = np.isfinite(ranges[:, 1]) & np.isfinite(ranges[:, 2])
    width = ranges[:, 3].copy()
    width[is_between] = ranges[is_between, 2] - ranges[is_between, 1]
    low, high = ranges[:, 1] + MARGIN * width, ranges[:, 2] - MARGIN * width
    # A value that is nearer to an end may stay there.
    return np.minimum(low, ranges[:, 0]), np.maximum(high, ranges[:, 0])


def least(rows: Vector, goal: Vector, damping: float, low: Vector, high: Vector) -> Vector:
    """The z of least `|rows z - goal|^2 + damping' |z|^2` within bounds: those it would cross are set to their ends."""
    z, is_free = np.zeros(rows.shape[1]), np.ones(rows.shape[1], bool)
    for _ in range(rows.shape[1] + 1):
        own = rows[:, is_free]
        square = own @ own.T
        scale = max(float(np.trace(square)), 1e-300)
        left = goal - rows[:, ~is_free] @ z[~is_free]
        best = own.T @ np.linalg.solve(square + damping * scale * np.eye(3), left)
        z[is_free] = np.clip(best, low[is_free], high[is_free])
        crossed = is_free.copy()
        crossed[is_free] = (best < low[is_free]) | (best > high[is_free])
        if not crossed.any():
            break
        is_free &= ~crossed
    return z


def wrapped(x: float) -> float:
    """An angle within half a turn of zero."""
    return x if -pi <= x <= pi else (x + pi) % tau - pi
