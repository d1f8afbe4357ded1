"""Descents of real choices, until the point is at the goal or no step brings it nearer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf, pi, tau

import numpy as np

from niwaki import _engine
from niwaki.search.drag.held import Held, State, Vector

#: A descent ends when the distance to the goal is this share of the scene's size.
DONE = 1e-4
#: The most steps of a descent, and the longest first step, in deviations of the priors.
STEPS, REACH = 24, 1.5
#: A descent ends if it comes no nearer by this share in this number of steps.
STALLED, PATIENCE = 0.02, 4
#: The most other branches of the model that a descent enters.
BRANCHES = 3
#: The distance of a number to an end of its range, as a share of the range.
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
    """Move choices until the point is at the goal, or no step brings it nearer.

    If a step leads into another branch of the model, the descent continues from the run there. The change from the
    start is least, or with `is_near_warm` the change from the values `warm`, at which the descent begins.
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
        is_other = there is None or [number[0] for number in there.movables] != [
            number[0] for number in here.movables
        ]
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
    """Descend from a run with other choices, if the part is nearer in it; missing choices are drawn."""
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
    """The ends between which values stay, a little within their ranges."""
    is_between = np.isfinite(ranges[:, 1]) & np.isfinite(ranges[:, 2])
    width = ranges[:, 3].copy()
    width[is_between] = ranges[is_between, 2] - ranges[is_between, 1]
    low, high = ranges[:, 1] + MARGIN * width, ranges[:, 2] - MARGIN * width
    # A value that is nearer to an end may stay there.
    return np.minimum(low, ranges[:, 0]), np.maximum(high, ranges[:, 0])


def least(rows: Vector, goal: Vector, damping: float, low: Vector, high: Vector) -> Vector:
    """The z of least `|rows z - goal|^2 + damping' |z|^2` within bounds; crossing numbers are set to the bound."""
    z, is_free = np.zeros(rows.shape[1]), np.ones(rows.shape[1], bool)
    for _ in range(rows.shape[1] + 1):
        part = rows[:, is_free]
        square = part @ part.T
        scale = max(float(np.trace(square)), 1e-300)
        left = goal - rows[:, ~is_free] @ z[~is_free]
        best = part.T @ np.linalg.solve(square + damping * scale * np.eye(3), left)
        z[is_free] = np.clip(best, low[is_free], high[is_free])
        crossed = is_free.copy()
        crossed[is_free] = (best < low[is_free]) | (best > high[is_free])
        if not crossed.any():
            break
        is_free &= ~crossed
    return z


def wrapped(x: float) -> float:
    """Wrap an angle to half a turn on both sides of zero."""
    return x if -pi <= x <= pi else (x + pi) % tau - pi
