"""Claim: `Result.polish` and `grow(polish=...)` continue from the best sample of a search, are at least as good, and
equal chains from those choices."""

from __future__ import annotations

import math
from dataclasses import replace

import niwaki as nw
import pytest
from niwaki import kernels
from niwaki.errors import InputError

COINS = 60


@nw.model
def row() -> int:
    """Coins that should all be heads: a chain from the prior needs many proposals for what a population ends with."""
    heads = 0
    for i in range(COINS):
        if nw.flip(0.5):
            heads = heads + 1
            nw.emit(nw.box((2.0 * i, 0.5, 0.0), (1.0, 1.0, 1.0)))
        nw.factor(-2.0 * ((i + 1) - heads) if i == COINS - 1 else 0.0)
    return heads


def searched(seed: int = 1) -> nw.Result:
    return nw.run(row, method=nw.smc(20), seed=seed)


def test_a_chain_starts_where_the_search_ended() -> None:
    result = searched()
    step = result.polish(nw.mh(1, keep=0))
    # One proposal changes one coin at most, so that the present state differs in one place at most.
    before, now = result.best.choices, step.last[0].choices
    assert sum(before[address] != now[address] for address in before) <= 1
    assert step.best.log_score >= result.best.log_score
    # Mutant: a chain from a new start differs in many.
    anew = nw.run(row, method=nw.mh(1, keep=0), seed=result.seed).last[0].choices
    assert sum(before[address] != anew[address] for address in before) > 5


def test_it_is_the_chain_of_those_choices() -> None:
    result = searched()
    method = nw.mh(200, kernel=kernels.neighbour(), keep=10)
    polished = result.polish(method, seed=7)
    by_hand = nw.run(row, method=method, choices=result.best.choices, seed=7)
    assert [s.choices for s in polished] == [s.choices for s in by_hand]
    assert polished.best.log_score == by_hand.best.log_score > result.best.log_score
    # A result can be polished again.
    assert polished.polish(method).best.log_score >= polished.best.log_score


@nw.model
def eye() -> float:
    """A number that no population draws, and a nearer one that moves find."""
    x = nw.uniform(0.0, 1.0)
    nw.factor(-1e9 * x if x < 1e-8 else -math.inf)
    return x


def test_rounds_of_improve_begin_at_the_best() -> None:
    result = searched()
    method = nw.improve(rounds=8)
    better = result.polish(method, seed=7)
    rounds = better.info.rounds
    assert [rounds[0].step, len(rounds)] == ["start", 9] and better.info.attempts == ()
    assert rounds[0].best == result.best.log_score < better.best.log_score == rounds[-1].best
    assert str(better.info).startswith("a run that was given")
    assert result.polish(method, seed=7, threads=1).best.choices == better.best.choices
    # Mutant: a search anew begins with a population, and not there.
    anew = nw.run(row, method=method, seed=7).info.rounds[0]
    assert anew.step == "population" and anew.best != result.best.log_score


def test_rounds_go_on_where_every_population_dies() -> None:
    start = nw.run(eye, choices={"x": 5e-9})
    better = start.polish(nw.improve(rounds=8), seed=1)
    assert start.best.log_score < better.best.log_score <= 0.0
    with pytest.raises(InputError, match="every run of the search is impossible"):
        nw.run(eye, method=nw.improve(rounds=8), seed=1)


def test_what_is_held_stays_in_rounds_from_a_run() -> None:
    result = searched()
    held = {address: value for address, value in result.best.choices.items() if not value}
    search = replace(result.search, hold=held)
    better = nw.Result(search, result.samples, result.seed).polish(nw.improve(rounds=8))
    assert better.best.choices.items() >= held.items()
    assert better.best.log_score <= result.best.log_score


def test_only_one_result_begins_at_a_run() -> None:
    with pytest.raises(InputError, match="or `improve` for one result"):
        searched().polish(nw.improve(diverse=3))


def test_its_time_is_that_of_both() -> None:
    result = searched()
    polished = result.polish(nw.mh(50))
    assert polished.cpu_seconds >= result.cpu_seconds and polished.seconds > result.seconds
    assert polished.best.seconds == polished.seconds


def test_grow_polishes_each_run() -> None:
    plain = nw.grow(row, score=nw.floor(), particles=10, runs=2, seed=5)
    better = nw.grow(row, score=nw.floor(), particles=10, runs=2, seed=5, polish=nw.mh(300, keep=0))
    assert [s.seed for s in better] == [s.seed for s in plain] == [5, 6]
    assert all(b.log_score > p.log_score for p, b in zip(plain, better, strict=True))


def test_what_makes_no_sense_is_refused() -> None:
    with pytest.raises(InputError, match="Metropolis-Hastings"):
        searched().polish(nw.smc(10))  # type: ignore[arg-type]
    with pytest.raises(InputError, match="diverse"):
        nw.grow(row, score=nw.floor(), particles=10, diverse=2, polish=nw.mh(10), seed=1)
