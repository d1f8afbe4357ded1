"""Claim: a part of the runs gives bounds that the exact answer keeps, and that close as more runs are visited."""

from __future__ import annotations

import math

import niwaki as nw
import pytest
from niwaki import condition, factor, flip, model, observe, poisson, sample, uniform
from niwaki.errors import InputError, ModelFault
from niwaki.words import Geometric, Poisson


@model
def waves():
    """Endlessly many runs of two counts; their sum is observed."""
    a = poisson(2.0)
    b = sample(Geometric(0.3))
    condition((a + b) % 2 == 0)
    observe(Poisson(1.0 + a), 3)
    return a > b


def exact() -> tuple[float, float]:
    """The probability that `waves` is true, and its evidence, by sums far beyond what counts."""
    sums = [0.0, 0.0]
    for a in range(80):
        for b in range(a % 2, 400, 2):
            prior = math.exp(a * math.log(2.0) - 2.0 - math.lgamma(a + 1)) * 0.3 * 0.7**b
            sums[a > b] += prior * math.exp(3 * math.log(1.0 + a) - 1.0 - a) / 6.0
    return sums[1] / sum(sums), sum(sums)


def test_the_bounds_hold_and_close() -> None:
    truth, evidence = exact()
    widths = []
    for runs in (3, 20, 100, 1000):
        result = nw.run(waves, method=nw.enumerate_all(max_runs=runs, likely=True))
        low, high = result.info.bounds(True)
        assert low <= truth <= high
        assert math.exp(result.log_evidence) <= evidence * (1 + 1e-9)
        assert math.exp(result.log_evidence) + math.exp(result.log_unseen) >= evidence * (1 - 1e-9)
        widths.append(high - low)
    assert widths == sorted(widths, reverse=True)
    assert widths[-1] < 1e-6
    # Forgetting what is left would put the truth outside.
    few = nw.run(waves, method=nw.enumerate_all(max_runs=3, likely=True))
    seen = [math.exp(log) for _, log in few.table]
    assert (
        abs(sum(p for (value, _), p in zip(few.table, seen, strict=True) if value) / sum(seen) - truth) > 0.01
    )


def test_of_few_runs_nothing_is_left() -> None:
    @model
    def coins():
        a, b = flip(0.3), flip(0.6)
        factor(-1.0 if a else 0.0)
        return a + b

    whole, part = (nw.run(coins, method=nw.enumerate_all(likely=likely)) for likely in (False, True))
    assert part.unseen == 0.0 and part.log_unseen is None
    assert dict(part.table) == pytest.approx(dict(whole.table))
    low, high = whole.info.bounds(1)
    assert low == high


def test_a_rest_that_adds_to_the_score_is_said() -> None:
    """A factor above 0 breaks the bounds of `rest=0`, and keeps those of its own size."""

    @model
    def late():
        n = poisson(1.0)
        factor(4.0 if n == 3 else 0.0)
        return n

    truth = math.exp(4.0) / 6.0 / (math.e - 1 / 6 + math.exp(4.0) / 6.0)
    for rest, holds in ((0.0, False), (4.0, True)):
        result = nw.run(late, method=nw.enumerate_all(max_runs=2, likely=True, rest=rest))
        low, high = result.info.bounds(3)
        assert (low <= truth <= high) == holds


def test_what_cannot_be_listed_is_refused() -> None:
    @model
    def smooth():
        return uniform(0, 1)

    with pytest.raises(ModelFault, match="not-enumerable"):
        nw.run(smooth, method=nw.enumerate_all(likely=True))
    with pytest.raises(InputError, match="likeliest"):
        nw.run(model(lambda: condition(poisson(1.0) > 50)), method=nw.enumerate_all(max_runs=5, likely=True))
    with pytest.raises(InputError, match="rest"):
        nw.enumerate_all(likely=True, rest=math.nan)
