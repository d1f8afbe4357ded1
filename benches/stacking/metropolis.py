"""Chains that do not follow the gradient: one choice at a time, with normal steps.

`original` is the dissertation's, as in its program: a step in the choice's own units, scored by the density of the
unbounded coordinates, Jacobian and all (which is the density of another model); bounds by clamping; a bandwidth for
each choice that starts at 0.002 and at every proposal, without end, grows or shrinks by 1 %, as the share accepted so
far is above 0.234 or below, which overshoots; latent forces start at zero. `adaptive` is correct: steps in the
coordinates that the density is over, each bandwidth led to an acceptance of 0.44 (the best for one coordinate) by gains
that fall, in the warm-up only, and the same start as the chains that follow the gradient.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from niwaki import stacks
from niwaki.result.gradient import LogDensity
from niwaki.stacks.starts import density_of, height

from stacking.files import Drawn
from stacking.kinds import Kind

#: Evaluations before the first draw, and for each draw: what 100 and one trajectory of 1000 steps were counted as.
BURN_IN, THIN = 200_000, 2000
TARGET, BEST = 0.234, 0.44
#: The logarithm of 1e-15, where the original's pushes start.
NEARLY_ZERO = np.log(1e-15)


def original(kind: Kind, chain: int, draws: int, warmup: int = BURN_IN, thin: int = THIN) -> Drawn:
    """The dissertation's chain."""
    start = time.process_time()
    density = density_of(kind.model, 100 * chain + 1, width=kind.width)
    density.compile()
    x = density.start.copy()
    for choice in density.choices:
        if choice.family == "exponential":
            x[choice.first] = NEARLY_ZERO
        elif choice.family == "student_t":
            x[choice.first] = 0.0
    units = Units(density, x)
    started = time.process_time()
    # The original's burn-in and its main run have bandwidths of their own.
    x, _, _ = walk(density, x, units, warmup, chain, lambda *_: None)
    burnt = time.process_time()
    kept: list[Any] = []
    x, _, accepted = walk(density, x, units, draws * thin, chain + 1000, keeper(kept, thin))
    return made(density, kept, started - start, burnt - started, burnt, draws * thin, accepted, "original")


def adaptive(kind: Kind, chain: int, draws: int, warmup: int = BURN_IN, thin: int = THIN) -> Drawn:
    """The chain that is put right."""
    start = time.process_time()
    density, x = stacks.start(kind.model, 100 * chain + 1, kind.width)
    started = time.process_time()
    x, steps, _ = walk(density, x, None, warmup, chain, lambda *_: None)
    burnt = time.process_time()
    kept: list[Any] = []
    x, _, accepted = walk(density, x, None, draws * thin, chain + 1000, keeper(kept, thin), steps)
    return made(density, kept, started - start, burnt - started, burnt, draws * thin, accepted, "adaptive")


SAMPLERS = {"mh-original": original, "mh-adaptive": adaptive}


class Units:
    """Between coordinates and the choices' own units, one at a time: bounded choices are logistic in theirs."""

    def __init__(self, density: LogDensity, x: Any) -> None:
        low, high = (density.values(np.full_like(x, end)) for end in (-40.0, 40.0))
        self.kind = {choice.first: choice.transform for choice in density.choices}
        self.low = {choice.first: low[choice.name] for choice in density.choices}
        self.high = {choice.first: high[choice.name] for choice in density.choices}

    def value(self, i: int, x: float) -> float:
        if self.kind[i] == "between":
            return self.low[i] + (self.high[i] - self.low[i]) / (1.0 + np.exp(-x))
        return float(np.exp(x)) if self.kind[i] == "above" else x

    def coordinate(self, i: int, value: float) -> float:
        if self.kind[i] == "between":
            value = min(max(value, self.low[i] + 1e-15), self.high[i] - 1e-15)
            return float(np.log((value - self.low[i]) / (self.high[i] - value)))
        return float(np.log(max(value, 1e-15))) if self.kind[i] == "above" else value


def walk(
    density: LogDensity,
    x: Any,
    units: Units | None,
    count: int,
    seed: int,
    see: Callable[[int, Any], None],
    frozen: Any = None,
) -> tuple[Any, Any, float]:
    """Make `count` proposals; return where they end, the steps, and the acceptance.

    Without units steps are in coordinates.
    """
    random = np.random.default_rng(seed)
    x = x.copy()
    steps = np.full(density.dim, 0.002 if units else 0.1) if frozen is None else frozen
    tried, accepts = np.zeros(density.dim), np.zeros(density.dim)
    score = height(density, x)[0]
    for number in range(count):
        i = int(random.integers(density.dim))
        before, by = x[i], steps[i] * random.normal()
        x[i] = units.coordinate(i, units.value(i, before) + by) if units else before + by
        height_now = height(density, x)[0]
        tried[i] += 1
        accepted = np.log(random.uniform()) < height_now - score
        if accepted:
            score = height_now
            accepts[i] += 1
        else:
            x[i] = before
        if frozen is None and units:
            steps[i] *= 1.01 if accepts[i] / tried[i] > TARGET else 1.0 / 1.01
        elif frozen is None:
            steps[i] *= np.exp((accepted - BEST) * tried[i] ** -0.6)
        see(number, x)
    return x, steps, float(accepts.sum() / max(tried.sum(), 1))


def keeper(kept: list[Any], thin: int) -> Callable[[int, Any], None]:
    def see(number: int, x: Any) -> None:
        if number % thin == thin - 1:
            kept.append(x.copy())

    return see


def made(
    density: LogDensity,
    kept: list[Any],
    start: float,
    burn_in: float,
    since: float,
    count: int,
    accepted: float,
    name: str,
) -> Drawn:
    values = [density.values(x) for x in kept]
    addresses = list(values[0])
    return Drawn(
        addresses,
        [[choices[name] for name in addresses] for choices in values],
        start,
        burn_in,
        time.process_time() - since,
        count,
        accepted,
        0,
        name,
    )
