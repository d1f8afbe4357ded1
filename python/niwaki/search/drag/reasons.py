"""Reasons why a part does not reach its goal, in plain words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from niwaki.search.drag.descent import bounds
from niwaki.search.drag.held import Held, State, Vector
from niwaki.shares import percent


def nothing_moves(held: Held) -> str:
    """Word that no free choice moves the part: all that could are held, or there are none."""
    labels = held.search.model.labels
    part = labels.label(held.start.part)
    slopes = held.all.slopes(held.at, held.grip.shape, held.grip.shares)
    moves = [] if slopes is None else np.abs(slopes).max(axis=0) > 0
    names = [
        labels.label(name)
        for (_, name, _), is_mover in zip(held.all.movables, moves, strict=False)
        if is_mover
    ]
    if not names:
        return f'no choice of a real number moves "{part}": its place follows from the source'
    many = (
        "the choice that moves it is held"
        if len(names) == 1
        else f"all {len(names)} choices that move it are held"
    )
    return f'no free choice moves "{part}": {many} ({_listed(names)})'


def too_far(held: Held, goal: Vector, state: State) -> str:
    """Word how near the part can come, and the reason."""
    labels = held.search.model.labels
    part = labels.label(state.part)
    share = f"{percent(state.error / held.size)} of the scene"
    left = f'the nearest that "{part}" can come is {state.error:.3g} away ({share})'
    here = held.whole(state)
    assert here is not None
    low, high = bounds(here.ranges)
    ends = []
    pull = (held.across @ (goal - here.point)) @ here.slopes
    for (_, name, _), (x, below, above, spread), want, lo, hi in zip(
        here.movables, here.ranges, pull, low, high, strict=True
    ):
        slack = 1e-3 * max(spread, 1e-12)
        if (x <= lo + slack and want < 0) or (x >= hi - slack and want > 0):
            ends.append(f'"{labels.label(name)}" is at the end of its range ({below:.3g} to {above:.3g})')
    if ends:
        more = f" and {len(ends) - 2} more" if len(ends) > 2 else ""
        return f"{left}: {'; '.join(ends[:2])}{more}"
    strength = np.linalg.svd(held.across @ here.slopes * here.ranges[:, 3], compute_uv=False)
    free = int((strength > 1e-6 * max(held.size, strength.max(initial=0.0))).sum())
    dimensions = int(round(float(np.trace(held.across))))
    if free < dimensions:
        moves = (
            "does not move it that way",
            "moves it along a line only",
            "moves it within a surface only",
        )
        return f"{left}: what is free {moves[free]}"
    return f"{left}: beyond this the choices bring it no nearer"


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(f'"{name}"' for name in names[:3])
    return f"{shown} and {len(names) - 3} more" if len(names) > 3 else shown
