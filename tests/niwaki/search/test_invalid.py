"""Claim: runs whose distributions have parameters out of range have probability zero in every search and are counted by
site in the result; alone, and where every run meets it, such a run is an error with its line.

Shares are over 4,000 independent runs and within 5 standard errors of enumeration: one false alarm in 1.7 million each.
"""

from __future__ import annotations

import math
from typing import Any

import niwaki as nw
import pytest
from niwaki import kernels


@nw.model
def coins() -> tuple[int, bool]:
    n = nw.discrete_uniform(0, 4)
    a = nw.flip((5 - n) / 4)
    nw.observe(nw.words.Gaussian(0, n - 1.5), 1.0)
    return n, a


@nw.model
def border() -> float:
    x = nw.uniform(0, 1)
    y = nw.uniform(0.5, x)
    nw.observe(nw.words.Gaussian(y, 0.2), 0.7)
    return x


@nw.model
def always(s: float) -> float:
    return nw.gaussian(0, -s)


#: The line of `def coins`.
LINE = coins.function.__code__.co_firstlineno + 1

METHODS: list[Any] = [
    nw.smc(particles=4000),
    nw.importance(4000),
    nw.rejection(1000, max_tries=20_000),
    nw.particle_gibbs(20, sweeps=50),
    nw.pimh(20, sweeps=50),
    nw.mh(steps=2000),
    nw.mh(steps=2000, kernel=kernels.block()),
    nw.enumerate_all(),
]
BLOCK = 6


@pytest.mark.parametrize("method", METHODS, ids=repr)
def test_runs_outside_of_the_support_are_counted_by_site(method: Any) -> None:
    result = nw.run(coins, method=method, seed=1)
    sites = [f"`bernoulli` at line {LINE + 2}", f"`gaussian` at line {LINE + 3}"]
    # Blocks move n by one, and do not come from 2 to 0.
    assert list(result.invalid) == (sites[1:] if method == METHODS[BLOCK] else sites)
    assert all(count > 0 for count in result.invalid.values())
    assert {value[0] for value, p in result.distribution().items() if p > 0} <= {2, 3, 4}


def test_shares_are_those_of_enumeration() -> None:
    exact = nw.run(coins, method=nw.enumerate_all()).distribution()
    assert math.isclose(sum(exact.values()), 1)
    shares = nw.run(coins, method=nw.rejection(4000), seed=2).distribution()
    for value, p in exact.items():
        assert abs(shares.get(value, 0.0) - p) < 5 * math.sqrt(p * (1 - p) / 4000)


@pytest.mark.parametrize(
    "method", [nw.nuts(draws=300, chains=2), nw.hmc(draws=300, chains=2)], ids=["nuts", "hmc"]
)
def test_trajectories_end_at_the_border(method: Any) -> None:
    result: Any = nw.run(border, method=method, seed=1)
    assert list(result.invalid) == [f"`uniform` at line {border.function.__code__.co_firstlineno + 3}"]
    assert result.divergences.impossible > 0
    assert result.divergences.not_finite == 0 and result.fault is None
    assert result.draws["x"].min() > 0.5


def test_chains_go_on_counting() -> None:
    result: Any = nw.run(coins, method=nw.mh(steps=500), seed=1)
    before = sum(result.invalid.values())
    assert sum(result.more(500).invalid.values()) > before
    assert nw.run(coins, method=nw.mh(steps=500), seed=1).invalid != result.invalid


@pytest.mark.parametrize("method", METHODS, ids=repr)
def test_what_every_run_meets_is_raised_with_its_line(method: Any) -> None:
    with pytest.raises(nw.ModelFault, match="`sd` of gaussian is -") as caught:
        nw.run(always, 1.0, method=method, seed=1)
    assert caught.value.code == "bad-parameter"
    assert "nw.gaussian(0, -s)" in caught.value.render()


def test_a_run_of_its_own_is_raised() -> None:
    for seed in range(40):
        try:
            nw.run(coins, method=nw.forward(), seed=seed)
        except nw.ModelFault as fault:
            assert fault.code == "bad-parameter"
            return
    pytest.fail("no run of forty met the border")
