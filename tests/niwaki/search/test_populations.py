"""Populations from Python: several, by time, that differ; chains of whole runs. The algorithms are tested in Rust."""

from __future__ import annotations

import math
import warnings
from collections import Counter
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki.errors import InputError
from niwaki.gallery import entry
from niwaki.search import SearchWarning

from tests.niwaki.search.test_search import COINS, exact, load, refused

GOLDEN = Path(__file__).parents[2] / "golden"

#: A seed with which neither coin falls on its head.
NEITHER = next(seed for seed in range(100) if nw.run(COINS, seed=seed).best.cause is not None)

WALL = load(
    """
@model
def m():
    bricks = [brick(i) for i in range(12)]
    return bricks

def brick(i):
    x = gaussian(0, 1)
    factor(-(x - i % 3) ** 2)
    return x
""",
    "wall.py",
)

RARE = load(
    """
@model
def m():
    x = flip(0.1)
    condition(x)
    return x
""",
    "rare.py",
)

NEVER = load(
    """
@model
def m():
    x = flip(0.1)
    condition(x and not x)
    return x
""",
    "never.py",
)


@pytest.mark.parametrize(
    "method",
    [
        nw.smc(particles=800, populations=5),
        nw.smc(particles=[3000, 500, 500]),
        nw.smc(particles=4000, anneal=[0.2, 3.0]),
        nw.smc(particles=4000, anneal=0.9),
        nw.particle_gibbs(particles=5, sweeps=6000),
        nw.pimh(particles=40, sweeps=6000),
        nw.smc(particles=4000, anneal=[9.0, 7.0], resampling="tempered"),
        nw.particle_gibbs(particles=5, sweeps=6000, anneal=[9.0, 7.0], resampling="tempered"),
        nw.pimh(particles=40, sweeps=6000, anneal=[9.0, 7.0], resampling="tempered"),
    ],
    ids=repr,
)
def test_each_follows_the_exact_answer(method: Any) -> None:
    """Fixed seed; 4.5 standard errors of 2500 independent draws: false alarm 7e-6 for each of 27 shares."""
    result = nw.run(COINS, method=method, seed=11, threads=1)
    shares = result.distribution()
    for value, share in exact().items():
        assert abs(shares.get(value, 0.0) - share) < 4.5 * math.sqrt(share * (1 - share) / 2500)
    if result.log_evidence is not None:
        assert result.log_evidence == pytest.approx(math.log(0.3 * math.exp(-0.5) + 0.42), abs=0.05)


def test_a_search_by_time_is_repeated_by_its_plan() -> None:
    timed = nw.run(WALL, method=nw.smc(seconds=0.3), seed=4)
    assert len(timed) == sum(timed.info.plan) and len(set(timed.info.plan)) == 1
    again = nw.run(WALL, method=nw.smc(particles=timed.info.plan), seed=4)
    assert timed.log_evidence == again.log_evidence
    assert [s.log_weight for s in timed] == [s.log_weight for s in again]


def shared(a: nw.Sample, b: nw.Sample) -> float:
    """The share of the choices of `a` that `b` has, by readable address."""
    return sum(a.choices[key] == b.choices.get(key) for key in a.choices) / len(a.choices)


def test_results_that_differ_share_at_most_half() -> None:
    result = nw.run(WALL, method=nw.smc(particles=60, diverse=4), seed=2)
    assert len(result) == 4 and result.info.plan == (60,) * 4
    assert all(shared(a, b) <= 0.5 for a in result for b in result if a is not b)
    assert result.unique_models == 4
    scores = [sample.log_score for sample in result]
    assert scores == sorted(scores, reverse=True)
    whole = nw.run(WALL, method=nw.smc(particles=60, populations=4), seed=2)
    assert result.best.log_score == whole.best.log_score


def test_a_chain_of_populations_counts_those_that_died() -> None:
    """Populations of one particle, 40 in all: 9 in 10 die; of all seeds 2e-5 have fewer than 27, and 0.015 have 40."""
    result = nw.run(RARE, method=nw.pimh(particles=1, sweeps=39), seed=3)
    assert 27 <= result.info.died < 40 and result.info.tries == 39 and len(result) <= 39
    assert result.log_evidence == pytest.approx(math.log((40 - result.info.died) / 40))
    with pytest.raises(InputError, match="everything-impossible"):
        nw.run(NEVER, method=nw.pimh(particles=3, sweeps=5), seed=3)


@pytest.mark.parametrize(
    "method", [nw.importance(300), nw.enumerate_all(), nw.smc(10), nw.pimh(10, 2)], ids=repr
)
def test_nothing_that_is_possible_is_an_error(method: Any) -> None:
    with pytest.raises(InputError, match="everything-impossible") as error:
        nw.run(NEVER, method=method, seed=1)
    assert "`condition` at line 7" in str(error.value)


def test_particle_gibbs_starts_from_a_possible_population() -> None:
    """Populations of two particles die with probability 0.81; ten populations all die for 12 seeds of 100."""
    result = nw.run(RARE, method=nw.particle_gibbs(particles=2, sweeps=39), seed=2)
    assert 0 < result.info.died < 40 and len(result) == 39
    with pytest.raises(InputError, match="`condition` at line"):
        nw.run(NEVER, method=nw.particle_gibbs(particles=3, sweeps=5), seed=3)


def test_samples_of_separate_runs_have_no_common_weights() -> None:
    several = nw.Search(COINS, method=nw.smc(5), seed=1, runs=3).run()
    for ask in (lambda: several.weights, several.distribution):
        with pytest.raises(InputError, match="weights-of-runs"):
            ask()


def test_enumeration_counts_impossible_runs() -> None:
    with pytest.raises(InputError, match="too-many-runs"):
        nw.run(RARE, method=nw.enumerate_all(max_runs=1), seed=1)


def test_weights_of_what_is_impossible_are_an_error() -> None:
    result = nw.run(RARE, method=nw.importance(200), seed=1)
    assert set(result.distribution()) == {True} and result.weights.sum() == pytest.approx(1.0)
    for sample in result:
        sample.log_weight = -math.inf
    for ask in (lambda: result.weights, result.distribution):
        with pytest.raises(InputError, match="everything-impossible"):
            ask()


def test_fewer_results_that_differ_give_a_warning() -> None:
    with pytest.warns(SearchWarning, match="of 30 results in 1 population differ;"):
        result = nw.run(COINS, method=nw.smc(particles=50, populations=1, diverse=30), seed=1)
    assert 1 <= len(result) < 30


def test_unique_models_agree_with_a_count_by_readable_addresses() -> None:
    for particles in (1, 30):
        result = nw.run(WALL, method=nw.smc(particles=particles, ess=0.5), seed=9)
        alone = [a for a in result if all(shared(a, b) <= 0.5 for b in result if a is not b)]
        assert result.unique_models == len(alone)
    assert nw.run(WALL, method=nw.forward(5), seed=1).unique_models == 5
    assert result.info.ancestors is not None and 1 <= result.info.ancestors <= 30


def test_grow_gives_what_differs() -> None:
    ship = entry("spaceship")
    assert ship is not None
    target = ship.target()
    assert target is not None
    settings: dict[str, Any] = {"voxel": 0.5, "seed": 5, "rule": "surface"}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = nw.grow(ship.model, target, particles=60, diverse=3, **settings)
    assert len(result) == result.unique_models == 3
    timed = nw.grow(ship.model, target, seconds=0.3, weights="ratio", **settings)
    again = nw.grow(ship.model, target, particles=timed.info.plan, **settings)
    assert timed.best.log_score == again.best.log_score


def test_a_chain_counts_its_moves_and_starts_from_given_choices() -> None:
    result = nw.run(WALL, method=nw.particle_gibbs(particles=6, sweeps=20), seed=3)
    assert len(result) == len(result.info.renewed) == 20
    assert (
        result.info.tries is not None
        and result.info.moves is not None
        and 0 < result.info.moves <= result.info.tries
    )
    kept = nw.run(WALL, method=nw.particle_gibbs(particles=6, sweeps=5, ancestors=False), seed=3)
    assert (kept.info.tries, kept.info.moves) == (0, 0)
    start = nw.run(WALL, seed=8).best
    method = nw.particle_gibbs(particles=2, sweeps=1, ancestors=False)
    near = nw.run(WALL, method=method, choices=start.choices, seed=1)
    assert Counter(near.best.choices) and any(near.best.choices[k] == v for k, v in start.choices.items())
    again = nw.run(WALL, method=nw.particle_gibbs(particles=6, sweeps=20), seed=3)
    assert [s.choices for s in again] == [s.choices for s in result]


def test_powers_are_reported() -> None:
    result = nw.run(WALL, method=nw.smc(particles=50, power=4.0, anneal=0.5), seed=1)
    assert len(result.info.powers) == result.info.barriers
    assert list(result.info.powers) == sorted(result.info.powers)
    held = nw.run(WALL, method=nw.smc(particles=50, power=4.0, anneal=result.info.powers), seed=1)
    assert held.best.log_score == result.best.log_score


def test_messages_of_populations(golden: Any) -> None:
    settings: dict[str, Any] = {
        "sizes": lambda: nw.smc(particles=[10, 0]),
        "no size": lambda: nw.smc(particles=[]),
        "sizes and populations": lambda: nw.smc(particles=[10, 20], populations=2),
        "populations": lambda: nw.smc(populations=0),
        "diverse": lambda: nw.smc(diverse=0),
        "seconds": lambda: nw.smc(seconds=0),
        "seconds and populations": lambda: nw.smc(seconds=1, populations=2),
        "an empty schedule": lambda: nw.smc(anneal=[]),
        "a share": lambda: nw.smc(anneal=1.5),
        "absolute": lambda: nw.smc(weights="absolute", anneal=0.5),
        "a chain that adapts": lambda: nw.pimh(anneal=0.5),
        "absolute and tempered": lambda: nw.smc(weights="absolute", resampling="tempered"),
        "alone": lambda: nw.particle_gibbs(particles=1),
        "evenly spread draws beside a held run": lambda: nw.particle_gibbs(resampling="systematic"),
        "sweeps": lambda: nw.particle_gibbs(sweeps=0),
        "a start that is impossible": lambda: nw.run(
            COINS, method=nw.particle_gibbs(), choices=nw.run(COINS, seed=NEITHER).best.choices, seed=1
        ),
    }
    sections = [f"## {name}\n\n{refused(ask)}\n" for name, ask in settings.items()]
    golden(GOLDEN / "populations.txt", "\n".join(sections))
