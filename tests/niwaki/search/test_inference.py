"""Claim: a model with an `infer` inside can itself be searched by every method, the same on any number of threads.

The inner choice is a coin that the outer run weighs: the outer answer follows from the inner posterior. Shares are
within 4.9 standard errors of it (one false alarm in a million each), and far from what leaving the outer factor out
would give.
"""

from __future__ import annotations

import math

import niwaki as nw
import pytest
from niwaki import factor, flip, infer, model, uniform

INNER = 0.3 / (0.3 + 0.7 * math.exp(-1.5))


@model
def coin(cost):  # type: ignore[no-untyped-def]
    """A coin whose tails cost something."""
    a = flip(0.3)
    factor(0.0 if a else cost)
    return a


@model
def twice():  # type: ignore[no-untyped-def]
    """An inner draw that the outer score prefers to be heads."""
    found = infer(coin, nw.mh(steps=50), -1.5)
    x = uniform(0.0, 1.0)
    factor(0.0 if found else -1.0)
    return found, x


OUTER = INNER / (INNER + (1.0 - INNER) * math.exp(-1.0))


@pytest.mark.parametrize(
    "method", [nw.importance(3000), nw.smc(particles=3000, ess=0.0)], ids=["importance", "smc"]
)
def test_the_outer_answer_is_known(method) -> None:  # type: ignore[no-untyped-def]
    result = nw.run(twice, method=method, seed=1)
    pairs = [(sample.value[0], weight) for sample, weight in zip(result, result.weights, strict=True)]
    share = sum(weight for value, weight in pairs if value)
    error = math.sqrt(sum((weight * (value - share)) ** 2 for value, weight in pairs))
    assert abs(share - OUTER) < 4.9 * error
    assert abs(INNER - OUTER) > 4.9 * error  # what leaving the outer factor out would give
    again = nw.run(twice, method=method, seed=1, threads=1)
    assert [sample.value for sample in again] == [sample.value for sample in result]


def test_a_chain_moves_the_seed() -> None:
    """Every 10th of 20,000 states: half the proposals redraw the seed, so that kept states are nearly independent."""
    chains = {
        strategy: nw.run(twice, method=nw.mh(steps=20_000, thin=10, keep=2000, strategy=strategy), seed=2)
        for strategy in ("c3", "resume", "cache", "rerun")
    }
    values = [sample.value for sample in chains["c3"]]
    assert len({sample.choices["found"] for sample in list(chains["c3"])[::100]}) > 5
    share = sum(value for value, _ in values) / len(values)
    assert abs(share - OUTER) < 4.9 * math.sqrt(OUTER * (1.0 - OUTER) / len(values))
    for result in chains.values():
        assert [sample.value for sample in result] == values


def test_a_replay_repeats_the_inner_search() -> None:
    best = nw.run(twice, seed=9).best
    assert list(best.choices) == ["found", "x"]
    assert nw.run(twice, choices=best.choices).value == best.value
    assert nw.run_python(twice, choices=best.choices).value == best.value


def test_an_outer_enumeration_is_refused() -> None:
    with pytest.raises(nw.NiwakiError, match="not-enumerable|no finite list"):
        nw.run(twice, method=nw.enumerate_all())
