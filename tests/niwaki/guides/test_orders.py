"""Claim: a learned order of futures is a setting like any other, is learned from a seed on any number of threads, and
changes no law.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import niwaki as nw
import pytest
from niwaki.guides import train_order
from niwaki.methods import FutureOrder, Method, particle_gibbs, pimh, smc
from niwaki.words import choose, emit, factor, flip, future, stroke

SKEWED = FutureOrder({"arm": 1.5, "tail": -2.0}, depth=0.5, turns=-1.0, waited=-0.5, stay=2.0)


@nw.model
def beast():  # type: ignore[no-untyped-def]
    """A side, of which only the tail says whether it is right; arms, whose luck decides who survives until then."""
    side = choose([0, 1, 2, 3, 4, 5, 6, 7])
    for _ in range(3):
        future(arm)
    future(tail, side)


def arm():  # type: ignore[no-untyped-def]
    """Four pieces of luck."""
    for _ in range(4):
        factor(1.0 if flip(0.5) else -1.0)


def tail(side):  # type: ignore[no-untyped-def]
    """One side is right."""
    factor(0.0 if side == 3 else -5.0)


#: The evidence by hand: twelve pieces of luck, and the side.
EVIDENCE = 12 * math.log(math.cosh(1.0)) + math.log(1 / 8 + 7 / 8 * math.exp(-5.0))


def searches() -> list[nw.Search]:
    return [nw.Search(beast)]


@pytest.mark.parametrize(
    "method", [smc(20, order=SKEWED), particle_gibbs(5, 4, order=SKEWED), pimh(5, 4, order=SKEWED)]
)
def test_an_order_is_a_setting_and_goes_through_json(method: Method) -> None:
    search = nw.Search(beast, method=method, seed=3)
    again = nw.Search.of_json(search.json())
    assert again.method == method
    assert again.hash == search.hash != replace(search, method=replace(method, order="stochastic")).hash  # type: ignore[call-arg]
    first, second = search.run(), again.run()
    assert [sample.log_score for sample in first] == [sample.log_score for sample in second]
    assert [sample.order for sample in first] == [sample.order for sample in second]


def test_an_order_without_numbers_is_the_uniform_one() -> None:
    uniform, zeros = (
        nw.run(beast, method=smc(30, order=order), seed=2) for order in ("stochastic", FutureOrder())
    )
    assert [sample.order for sample in uniform] == [sample.order for sample in zeros]
    skewed = nw.run(beast, method=smc(30, order=SKEWED), seed=2)
    assert [sample.order for sample in uniform] != [sample.order for sample in skewed]


@pytest.mark.parametrize("order", ["stochastic", "depth-first", SKEWED])
def test_the_evidence_does_not_depend_on_the_order(order: Any) -> None:
    """Its mean over 400 seeds, within 5 standard errors: a false alarm once in 1.7 million."""
    values = [
        math.exp(nw.run(beast, method=smc(20, order=order), seed=seed, threads=1).log_evidence - EVIDENCE)
        for seed in range(400)
    ]
    mean = sum(values) / len(values)
    error = math.sqrt(sum((value - mean) ** 2 for value in values)) / len(values)
    assert abs(mean - 1.0) < 5 * error


def test_training_finds_the_order_that_wastes_least() -> None:
    """An early tail, while all sides are still there, as the mean log of the evidence shows."""
    training = train_order(beast, searches(), method=smc(12), rounds=4, orders=24, judging=200, seed=1)
    assert training.order == training.rounds[-1]
    assert training.learned > training.uniform + 3 * training.error
    assert training.order.functions["tail"] > training.order.functions["arm"]


def test_training_depends_on_the_seed_alone() -> None:
    def trained(seed: int, threads: int) -> Any:
        return train_order(
            beast,
            searches(),
            method=smc(6),
            rounds=2,
            orders=6,
            runs=2,
            judging=4,
            seed=seed,
            threads=threads,
        )

    assert trained(1, 1) == trained(1, 2) != trained(2, 1)


def test_an_order_that_is_no_better_is_not_given() -> None:
    """Without futures all orders are one."""

    @nw.model
    def plain():  # type: ignore[no-untyped-def]
        emit(stroke((0.0, 0.0, 0.0), (1.0, 1.0, 0.0), 0.1, 0.1))

    training = train_order(plain, [nw.Search(plain)], method=smc(4), rounds=1, orders=4, judging=2, seed=1)
    assert training.order == FutureOrder() != training.rounds[-1]


@pytest.mark.parametrize(
    "make",
    [
        lambda: FutureOrder(stay=math.nan),
        lambda: FutureOrder(depth=51.0),
        lambda: FutureOrder({"arm": math.inf}),
        lambda: smc(order="breadth-first"),
        lambda: train_order(beast, []),
        lambda: train_order(beast, searches(), method=smc(10, weights="absolute")),
        lambda: train_order(beast, searches(), orders=0),
    ],
)
def test_what_makes_no_sense_is_refused(make: Any) -> None:
    with pytest.raises(nw.InputError) as caught:
        make()
    assert caught.value.code == "bad-setting"


def test_data_of_another_form_are_refused() -> None:
    text = nw.Search(beast, method=smc(5, order=SKEWED), seed=1).json()
    with pytest.raises(nw.InputError):
        nw.Search.of_json(text.replace('"stay"', '"stays"'))
