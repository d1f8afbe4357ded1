"""Claim: host functions run one at a time in a process, in all of its searches, unless they are marked as safe for
threads; one that searches itself lends its turn, and nobody waits for ever. No result depends on it.

A test whose functions would wait for each other for ever ends by the limits of its barriers.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import niwaki as nw
import pytest
from niwaki.words import Gaussian

METHODS: list[Any] = [
    nw.importance(64),
    nw.smc(64),
    nw.mh(steps=30, chains=4),
    nw.particle_gibbs(16, sweeps=3),
]


class Inside:
    """How many threads are inside of a function at once, at most."""

    def __init__(self) -> None:
        self.now = self.most = 0

    def __enter__(self) -> None:
        self.now += 1
        self.most = max(self.most, self.now)
        # Others may run here, and would come in.
        time.sleep(0.0005)
        self.most = max(self.most, self.now)

    def __exit__(self, *_: object) -> None:
        self.now -= 1


def using(first: Any, second: Any = None) -> Any:
    """A model that calls host functions."""
    second = second or first

    @nw.model
    def model() -> float:
        x = nw.uniform(0, 1)
        y = first(x)
        nw.observe(Gaussian(y, 1.0), 0.3)
        z = second(nw.uniform(0, 1))
        nw.observe(Gaussian(z, 1.0), 0.3)
        return y + z

    return model


@pytest.mark.parametrize("method", METHODS, ids=repr)
def test_one_runs_at_a_time(method: Any) -> None:
    inside = Inside()

    @nw.host
    def first(x: float) -> float:
        with inside:
            return x

    @nw.host
    def second(x: float) -> float:
        with inside:
            return 2 * x

    model = using(first, second)
    several = nw.run(model, method=method, seed=1, threads=4)
    assert inside.most == 1
    alone = nw.run(model, method=method, seed=1, threads=1)
    assert [sample.log_weight for sample in several] == [sample.log_weight for sample in alone]


def test_one_runs_at_a_time_in_several_searches() -> None:
    inside = Inside()

    @nw.host
    def slow(x: float) -> float:
        with inside:
            return x

    with ThreadPoolExecutor(3) as pool:
        list(pool.map(lambda seed: nw.run(using(slow), nw.importance(20), seed=seed, threads=2), range(3)))
    assert inside.most == 1


def test_those_that_are_marked_run_together() -> None:
    together = threading.Barrier(2)

    @nw.host(threads=True)
    def meets(x: float) -> float:
        together.wait(60)
        return x

    @nw.model
    def model() -> float:
        return meets(nw.uniform(0, 1))

    assert len(nw.run(model, nw.importance(2), seed=1, threads=2)) == 2


def _searching(method: Any, run: Callable[..., Any] = nw.run) -> Any:
    @nw.host
    def inner(x: float) -> float:
        return x + 1

    @nw.model
    def small() -> float:
        return inner(nw.uniform(0, 1))

    @nw.host
    def outer(x: float) -> float:
        return float(run(small, method, seed=1).best.value) + inner(x)

    return using(outer)


@pytest.mark.parametrize("method", [nw.importance(8), nw.forward(), nw.mh(steps=5, chains=2)], ids=repr)
def test_one_that_searches_lends_its_turn(method: Any) -> None:
    model = _searching(method)
    several = nw.run(model, nw.importance(16), seed=1, threads=4)
    alone = nw.run(model, nw.importance(16), seed=1, threads=1)
    assert [sample.log_weight for sample in several] == [sample.log_weight for sample in alone]


def test_an_exception_inside_a_search_inside_gives_the_turn_back() -> None:
    @nw.host
    def fails(x: float) -> float:
        raise ValueError("never")

    @nw.model
    def small() -> float:
        return fails(nw.uniform(0, 1))

    @nw.host
    def outer(x: float) -> float:
        if x < 0.5:
            nw.run(small, nw.importance(4), seed=1)
        return x

    result = nw.run(using(outer), nw.importance(32), seed=1, threads=3)
    assert result.invalid[0].name == "outer" and 0 < result.invalid[0].runs < 32
    assert nw.run(using(outer), nw.importance(32), seed=1, threads=1).invalid == result.invalid


def test_the_mark_is_kept() -> None:
    @nw.host(threads=True)
    def twice(x: float) -> float:
        """Twice as much."""
        return 2 * x

    assert (twice.threads, twice(2.0), twice.name, twice.__doc__) == (True, 4.0, "twice", "Twice as much.")

    @nw.host
    def once(x: float) -> float:
        return x

    assert not once.threads
