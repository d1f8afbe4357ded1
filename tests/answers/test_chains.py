"""Every kernel and composition agrees with enumeration on every model that it suits, through Python.

Seeds are fixed. Each row makes 40,000 proposals after a warm-up of 2,000, and compares the share of each value with the
exact share. The unit is the spread of the shares of 40 stretches of the chain, which are nearly independent: |t| with
39 degrees of freedom passes 6 once in two million. With some 250 shares, a re-seeded board fails once in eight thousand
runs. The mutants that must be rejected, and continuous models, are in `crates/search/tests/chain`.
"""

from __future__ import annotations

import linecache
import math
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import kernels as k
from niwaki.words import Binomial, Categorical, Gaussian

TEXT = """
from niwaki import model; from niwaki.words import *

@model
def coins():
    a = flip(0.3)
    b = flip(0.9 if a else 0.2)
    factor(0.0 if a == b else -1.5)
    return (a, b)

def more(n):
    if n < 4 and flip(0.6):
        return more(n + 1)
    return n

@model
def depth():
    n = more(0)
    factor(0.8 * n)
    return n

@model
def bounds():
    n = discrete_uniform(1, 3)
    j = discrete_uniform(0, n)
    factor(0.5 * j)
    return (n, j)

@model
def shapes():
    if flip(0.4):
        total = sum([binomial(2, 0.3) for _ in range(2)])
    else:
        total = categorical([0.2, 0.5, 0.3]) + 5
    observe(Gaussian(total, 2.0), 3.0)
    return total

@model
def states():
    s = 0
    T = [[0.7, 0.2, 0.1], [0.1, 0.5, 0.4], [0.3, 0.3, 0.4]]
    for i in range(4):
        s = categorical(T[s])
        observe(Categorical(T[s]), i % 3)
        query(i, s)
    return s

@model
def later():
    task = future(more, 2)
    a = flip(0.5)
    n = force(task)
    factor(-0.6 * n if a else 0.0)
    return (a, n)
"""


def loaded() -> dict[str, Any]:
    name = "answers-of-chains.py"
    linecache.cache[name] = (len(TEXT), None, TEXT.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "answers"}
    exec(compile(TEXT, name, "exec"), space)
    return space


MODELS = loaded()
NAMES = ("coins", "depth", "bounds", "shapes", "states", "later")

KERNELS = {
    "mh": k.prior(),
    "drift": k.drift(),
    "neighbour": k.neighbour(2),
    "block and mh": k.cycle(k.block(share=0.5), k.prior()),
    "regenerate": k.regenerate(),
    "regenerate one above": k.regenerate(1),
    "regrow": k.regrow(3),
    "regrow by choice": k.regrow(2, turn=1.0, pick="choice"),
    "mixture": k.mixture(k.prior(), k.regenerate(), k.neighbour(), weights=[1, 2, 1]),
    "repeat": k.repeat(2, k.cycle(k.prior(), k.neighbour())),
    "selection weight by depth": k.weighted(k.prior(), depth=lambda depth: 1 / (1 + depth) ** 2),
    "temper": k.tempering(k.prior(), (1, 1 / 3, 1 / 9), every=20),
}


def t_values(model: Any, kernel: k.Kernel, steps: int = 22_000, seed: int = 5, **settings: Any) -> float:
    """The largest |t| over the values of a model."""
    exact = nw.run(model, method=nw.enumerate_all()).distribution()
    result = nw.run(model, nw.mh(steps=steps, warmup=2_000, thin=2, kernel=kernel, **settings), seed=seed)
    values = [sample.value for sample in result]
    stretches = np.array_split(np.arange(len(values)), 40)
    largest = 0.0
    for target, share in exact.items():
        hits = np.array([value == target for value in values], dtype=float)
        shares = np.array([hits[stretch].mean() for stretch in stretches])
        error = max(shares.std(ddof=1) / math.sqrt(len(shares)), 1e-4)
        largest = max(largest, abs(shares.mean() - share) / error)
    return largest


@pytest.mark.parametrize("steps", [22_000, pytest.param(102_000, marks=pytest.mark.soak)])
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("kernel", KERNELS)
def test_kernels_answer_as_enumeration_does(kernel: str, name: str, steps: int) -> None:
    assert t_values(MODELS[name], KERNELS[kernel], steps) < 6


@pytest.mark.parametrize("strategy", ["c3", "resume", "cache", "rerun"])
def test_strategies_answer_as_enumeration_does(strategy: str) -> None:
    assert t_values(MODELS["shapes"], k.prior(), strategy=strategy) < 6


@pytest.mark.parametrize(
    ("name", "sites"),
    [("coins", {"a": 3.0, "*": 0.5}), ("shapes", {"*bernoulli*": 0.3}), ("bounds", {"j": 4.0})],
)
def test_selection_weights_by_site_answer_as_enumeration_does(name: str, sites: dict[str, float]) -> None:
    assert t_values(MODELS[name], k.weighted(k.prior(), sites=sites)) < 6


def test_a_proposal_of_ones_own_answers_as_enumeration_does() -> None:
    """It prefers small numbers whatever the old one: without its reverse density the answer would be another."""
    kernel = k.on("j", k.proposal(lambda old: Binomial(3, 0.2 if old == 0 else 0.6)))
    assert t_values(MODELS["bounds"], k.cycle(k.prior(), kernel)) < 6


def test_selections_leave_the_rest_alone() -> None:
    result = nw.run(MODELS["coins"], nw.mh(steps=500, kernel=k.on("a", k.prior())), seed=1)
    assert len({sample.value[1] for sample in result}) == 1
    assert len({sample.value[0] for sample in result}) == 2


def test_annealing_finds_the_mode_and_the_prior_is_not_tempered() -> None:
    result = nw.run(MODELS["depth"], nw.mh(steps=2000, kernel=k.anneal(k.prior(), 1500, 0.2, 20.0)), seed=2)
    assert result.best.value == 4
    assert result.last[0].value == 4


def test_the_answers_are_not_vacuous() -> None:
    """A chain without the observation misses the exact answer by far."""
    exact = nw.run(MODELS["shapes"], method=nw.enumerate_all()).distribution()
    prior = nw.run(MODELS["shapes"], method=nw.forward(20_000), seed=1).distribution()
    assert max(abs(exact[value] - prior.get(value, 0.0)) for value in exact) > 0.05
    assert Categorical and Gaussian
