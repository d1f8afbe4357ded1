"""Searches that are killed: run as `python resumed.py CASE FILE`, which prints a digest of the result.

Each case is told by effort, so its digest is the same however often it was killed.
"""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import kernels
from niwaki.gallery.gnarly_tree import gnarly_tree
from niwaki.guides import Training
from niwaki.result.chains import MhInfo
from niwaki.result.info import ImproveInfo
from niwaki.targets.examples import bent_tube
from niwaki.words import (
    DiscreteUniform,
    Gamma,
    Gaussian,
    Poisson,
    emit,
    flip,
    gaussian,
    look,
    observe,
    sample,
    stroke,
)

#: The checkpoint is written as often as the engine gives something.
EVERY = 0.01

DATA = [-4.1, 0.2, 5.3, -3.8, 4.9, 0.1, -0.3, 5.1, -4.4, 4.7, 0.4, -3.9]
WINDOW = ((-2.0, -1.0), (2.0, 3.0))


@nw.model
def mixture(data):  # type: ignore[no-untyped-def]
    """Components of a random number, and a label for each number."""
    k = sample(Poisson(2.0))
    means = [gaussian(0, 5) for _ in range(k + 1)]
    spread = sample(Gamma(2.0, 1.0))
    for i in range(len(data)):
        label = sample(DiscreteUniform(0, k))
        observe(Gaussian(means[label], spread + 0.1), data[i])
    return k, spread


@nw.model
def invalid(data):  # type: ignore[no-untyped-def]
    """A spread that is often below zero."""
    spread = gaussian(1.0, 1.0)
    mean = gaussian(0.0, spread)
    observe(Gaussian(mean, 1.0), data[0])
    return mean


@nw.model
def path():  # type: ignore[no-untyped-def]
    """Two or three strokes."""
    step(0.0, -0.6, 0)


@nw.model
def step(x, y, depth):  # type: ignore[no-untyped-def]
    """One stroke, and perhaps another."""
    look((x, y), (0.0, 1.0))
    aside, tall = gaussian(0.0, 0.9), gaussian(1.0, 0.1)
    emit(stroke((x, y, 0.0), (x + aside, y + tall, 0.0), 0.7, 0.4))
    if depth < 1 or (depth < 3 and flip(0.5)):
        step(x + aside, y + tall, depth + 1)


def page(side: int) -> Any:
    """A slanted bar that leads to one side."""
    greys = np.full((24, 24), 255, dtype=np.uint8)
    for row in range(2, 22):
        middle = 12 + side * (row - 12) // 3
        greys[row, middle - 3 : middle + 3] = 0
    return greys


ALL = kernels.mixture(
    kernels.prior(),
    kernels.on("spread", kernels.drift(0.3)),
    kernels.regenerate(0),
    kernels.block(0.2, 0.3),
    kernels.cycle(kernels.hmc_step(steps=4), kernels.nuts_step(max_depth=3)),
    weights=[4, 2, 1, 1, 2],
)
POWERS = kernels.tempering(
    kernels.anneal(kernels.mixture(kernels.prior(), kernels.drift(0.5)), 1000, 0.5, 1.0), [1.0, 0.5, 0.2]
)


def improve(**settings: Any) -> Any:
    """The usual search."""
    return nw.grow(gnarly_tree, bent_tube(), 0.2, voxel=0.4, rounds=25, seed=5, threads=1, **settings)


def several(**settings: Any) -> Any:
    """Results that differ."""
    return nw.grow(gnarly_tree, bent_tube(), 0.2, voxel=0.5, rounds=4, diverse=3, seed=5, **settings)


def runs(**settings: Any) -> Any:
    """Several runs of a population, each polished."""
    method = nw.smc(40)
    polish = nw.mh(2000, kernel=kernels.mixture(kernels.prior(), kernels.drift()))
    return nw.grow(
        gnarly_tree, bent_tube(), 0.2, voxel=0.5, method=method, polish=polish, runs=3, seed=5, **settings
    )


def chain(**settings: Any) -> Any:
    """Chains by many kernels."""
    method = nw.mh(kernel=ALL, steps=20_000, warmup=8_000, chains=2, keep=50)
    return nw.run(mixture, DATA, method=method, seed=3, **settings)


def ladder(**settings: Any) -> Any:
    """Chains at several powers."""
    method = nw.mh(kernel=POWERS, steps=150_000, warmup=3_000, chains=2, keep=50)
    return nw.run(mixture, DATA, method=method, seed=3, **settings)


def outside(**settings: Any) -> Any:
    """Proposals with an invalid distribution, which are counted."""
    return nw.run(invalid, DATA, method=nw.mh(steps=1_000_000, chains=2, keep=50), seed=3, **settings)


def training(**settings: Any) -> Any:
    """A guide."""
    return nw.train_guide(
        path,
        (-2, -1, 1, 2, -3, 3, 0, 1, -1),
        lambda side: nw.match_drawing(page(side), WINDOW),
        rounds=(12, 12),
        searches=(nw.smc(60), nw.smc(20, resampling="tempered")),
        training=Training(steps=600, hidden=(8, 8)),
        seed=4,
        **settings,
    )


def bound(**settings: Any) -> Any:
    """A guide by the evidence bound."""
    return nw.train_guide(
        path,
        (-2, -1, 1, 2, -3, 3, 0, 1, -1),
        lambda side: nw.match_drawing(page(side), WINDOW),
        training=Training.bound(steps=300, hidden=(8, 8)),
        seed=4,
        **settings,
    )


CASES: dict[str, Callable[..., Any]] = {
    case.__name__: case for case in (improve, several, runs, chain, ladder, outside, training, bound)
}


def digest(result: Any) -> str:
    """SHA-256 of all that the result is, but for its times."""
    if isinstance(result, nw.Guide):
        return hashlib.sha256(result.data).hexdigest()
    facts: list[Any] = [result.search.hash, result.invalid]
    states = [*result.samples]
    if isinstance(result.info, ImproveInfo):
        facts += [result.info.attempts, result.info.rounds, result.info.searches]
    if isinstance(result.info, MhInfo):
        states += [*result.bests, *result.last]
        facts += [
            result.acceptance,
            result.visits,
            [(state.step, state.made) for state in result.trajectories],
        ]
    facts += [(state.choices, state.log_score, state.log_prior, state.value) for state in states]
    return hashlib.sha256(repr(facts).encode()).hexdigest()


def main(case: str, place: str) -> None:
    """Search, or go on, and print the digest."""
    Path(f"{place}.begun").touch()
    print(digest(CASES[case](checkpoint=nw.Checkpoint(place, every=EVERY))))


if __name__ == "__main__":
    main(*sys.argv[1:])
