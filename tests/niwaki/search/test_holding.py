"""Holding choices and growing parts again: the law given what is held, values to the bit, and messages."""

from __future__ import annotations

import math
import os
import random
import secrets
from collections import Counter
from dataclasses import replace
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.errors import InputError, NiwakiError
from niwaki.gallery import entry
from niwaki.result.info import EnumerationInfo
from niwaki.words import Gaussian


@nw.model
def legs():
    """Up to three legs, some of them with a foot; the value tells all choices."""
    count = nw.discrete_uniform(1, 3)
    made = []
    for _ in range(count):
        made = made + [leg()]
    nw.factor(-0.4 * count)
    return (count, made)


@nw.model
def leg():
    """A leg: how long, and its foot."""
    length = nw.categorical([0.5, 0.3, 0.2])
    nw.factor(-0.3 * length)
    foot = -1
    if nw.flip(0.4 + 0.2 * length):
        foot = nw.discrete_uniform(0, 2)
    return (length, foot)


@nw.model
def slope():
    """A real choice that bends the mean of another."""
    x = nw.gaussian(0.5, 1.0)
    y = nw.gaussian(x + 0.1 * x * x, 0.8)
    nw.observe(Gaussian(y - x, 1.0), 0.3)
    return x


def leg_of(number: int) -> str:
    """The address of a leg."""
    paths = nw.run(legs, seed=1, choices={"count": 3}).best.choices
    calls = sorted({path.rpartition("/")[0] for path in paths if path.endswith("length")})
    return calls[number]


def shares(result: nw.Result) -> dict[str, float]:
    """The weighted shares of the values."""
    counts: Counter[str] = Counter()
    for value, share in result.distribution().items():
        counts[str(value)] += share
    return dict(counts)


def furthest(shares: dict[str, float], exact: dict[str, float], effective: float) -> float:
    """The largest |z| of the shares that are not rare; no value may be impossible."""
    assert set(shares) <= set(exact)
    common = {value: p for value, p in exact.items() if p * effective > 20}
    assert len(common) > 2
    return max(abs(shares.get(v, 0.0) - p) / math.sqrt(p * (1 - p) / effective) for v, p in common.items())


def test_the_law_is_that_of_the_free_program_with_those_values() -> None:
    place = leg_of(1)
    hold = {f"{place}/length": 2}
    free = nw.run(legs, nw.enumerate_all())
    assert isinstance(free.info, EnumerationInfo)
    # Only runs with a second leg, and of that length.
    kept = {str(v): math.exp(log) for v, log in free.info.table if v[0] > 1 and v[1][1][0] == 2}
    exact = {value: p / sum(kept.values()) for value, p in kept.items()}
    bound = nw.run(legs, nw.enumerate_all(), hold=hold)
    assert shares(bound) == pytest.approx(exact)
    assert bound.log_evidence == pytest.approx(math.log(sum(kept.values())))
    # Beyond 5 standard errors a share lies once in 1.7 million; some 60 are looked at.
    weighed = nw.run(legs, nw.importance(20_000), hold=hold, seed=2)
    effective = 1 / float(np.sum(weighed.weights**2))
    assert furthest(shares(weighed), exact, effective) < 5


def by_quadrature(y: float) -> tuple[float, float]:
    """Mean and deviation of `slope`'s x, where its y is held."""
    x = np.linspace(-6, 6, 20_001)
    log = -0.5 * (x - 0.5) ** 2 - 0.5 * ((y - x - 0.1 * x * x) / 0.8) ** 2 - 0.5 * (0.3 - y + x) ** 2
    weight = np.exp(log - log.max())
    mean = float((weight * x).sum() / weight.sum())
    return mean, math.sqrt(float((weight * (x - mean) ** 2).sum() / weight.sum()))


@pytest.mark.parametrize(
    "method",
    [
        nw.nuts(draws=4000, chains=2, warmup=500),
        nw.hmc(draws=4000, chains=2, warmup=500),
        nw.mh(40_000, thin=10, kernel=nw.kernels.cycle(nw.kernels.drift(0.5), nw.kernels.nuts_step())),
        nw.smc(particles=20_000),
    ],
    ids=lambda method: method.NAME,
)
def test_continuous_choices_follow_the_law_given_a_held_one(method: Any) -> None:
    """Within five errors of a sample of 500 that are independent: far fewer than there are."""
    mean, deviation = by_quadrature(0.16)
    result = nw.run(slope, method, hold={"y": 0.16}, seed=4)
    assert all(sample.choices["y"] == 0.16 for sample in list(result)[:5])
    values = np.array([sample.choices["x"] for sample in result])
    weights = result.weights
    assert abs(float((weights * values).sum()) - mean) < 5 * deviation / math.sqrt(500)


def test_a_search_for_the_best_and_its_polish_keep_what_is_held() -> None:
    hold = {f"{leg_of(1)}/length": 1, f"{leg_of(0)}/length": 2}
    improved = nw.run(legs, nw.improve(rounds=5), hold=hold, seed=1)
    polished = nw.run(legs, nw.smc(particles=50), hold=hold, seed=1).polish(nw.mh(500))
    for result in (improved, polished):
        assert hold.items() <= result.best.choices.items()


def test_a_lock_is_part_of_a_search() -> None:
    search = nw.Search(legs, method=nw.smc(particles=20), seed=4, hold={f"{leg_of(0)}/length": 1})
    again = nw.Search.of_json(search.json())
    assert again.hash == search.hash != nw.Search(legs, method=nw.smc(particles=20), seed=4).hash
    values = [[sample.value for sample in locked.run()] for locked in (search, again)]
    assert values[0] == values[1]


def test_patterns_and_parts_are_resolved_once() -> None:
    sample = nw.run(legs, seed=1, choices={"count": 3}).best
    every, first, second = sample.choices, leg_of(0), leg_of(1)

    def below(place: str) -> set[str]:
        return {path for path in every if path.startswith(place + "/")}

    assert sample.held() == every
    assert set(sample.held("length")) == {path for path in every if path.endswith("length")}
    # A part has what decides that it exists: here how many there are.
    assert set(sample.held(first)) == below(first) | {"count"}
    assert set(sample.held(second)) >= below(second) | {"count"}
    assert all(every[path] == value for path, value in sample.held(second, "count").items())
    with pytest.raises(InputError) as caught:
        sample.held("lenght")
    assert caught.value.code == "no-address" and "length" in str(caught.value)


def test_what_decides_that_a_part_exists_is_above_and_before_it() -> None:
    @nw.model
    def tower():
        total = 0.0
        while nw.flip(0.8):
            width = nw.uniform(0.5, 1.0)
            nw.emit(nw.box((0.0, total, 0.0), (width, 1.0, width)))
            total = total + 1.0

    sample = nw.run(
        tower, seed=next(s for s in range(99) if len(nw.run(tower, seed=s).best.choices) > 8)
    ).best
    place = [address for address, _ in sample._trace.parts][2]
    held = sample.held(place)
    flips = [path for path in sample.choices if "flip" in path or "bernoulli" in path]
    assert set(flips[:3]) <= set(held) and len(held) >= 4 and not set(held) & set(flips[3:])
    assert nw.run(tower, nw.smc(particles=20), hold=held, seed=1).best.primitives >= 3


@pytest.mark.parametrize("power", [1.0, 2.0])
def test_a_part_grown_again_follows_the_law_given_the_rest(power: float) -> None:
    sample = nw.run(legs, seed=5, choices={"count": 2}).best
    part = leg_of(1)
    rest = {path: value for path, value in sample.choices.items() if not path.startswith(part + "/")}
    bound = nw.run(legs, nw.enumerate_all(), hold=rest)
    assert isinstance(bound.info, EnumerationInfo)
    sharper = {}
    for value, log in bound.info.table:
        score = -0.4 * value[0] - 0.3 * sum(sampled[0] for sampled in value[1])
        sharper[str(value)] = math.exp(log + (power - 1) * score)
    exact = {value: p / sum(sharper.values()) for value, p in sharper.items()}
    again = sample.regrow(part, particles=20_000, power=power, seed=1)
    # Particles that were resampled together are fewer independent ones; a third is far below what is left of them.
    assert furthest(shares(again), exact, 20_000 / 3) < 5
    assert all(rest.items() <= sampled.choices.items() for sampled in again)


def test_growing_a_part_again_changes_nothing_else() -> None:
    ship = entry("spaceship")
    assert ship is not None
    grown = nw.grow(ship.model, ship.target(), method=nw.smc(particles=60), voxel=ship.voxel, seed=3)
    wings = sorted({path.rpartition("/")[0] for path in grown.best.choices if "wings" in path})
    part = wings[0]
    again = grown.regrow(part, particles=40, seed=8)
    before = grown.best.choices
    outside = {path: value for path, value in before.items() if not path.startswith(part + "/")}
    for sample in again:
        assert {p: v for p, v in sample.choices.items() if not p.startswith(part + "/")} == outside
    assert len({str(sample.choices) for sample in again}) > 1
    twice = grown.regrow(part, particles=40, seed=8)
    assert [run.log_score for run in twice] == [run.log_score for run in again]
    assert again.weights.sum() == pytest.approx(1.0)
    for pattern, code in (("wnigs", "no-part"), ("**wings", "many-parts")):
        with pytest.raises(InputError) as caught:
            grown.regrow(pattern)
        assert caught.value.code == code and "wings" in str(caught.value)


@nw.model
def row(level):
    """Two boxes in a row."""
    for k in range(2):
        nw.emit(nw.box((3.0 * k, 3.0 * level, 0.0), (1.0, 1.0, nw.uniform(0.5, 1.0))))


@nw.model
def rows():
    """Two rows, whose loop has the same variable: `k[1]` is the second row, and the end of each second box."""
    for k in range(2):
        row(k)


def test_a_whole_address_names_one_part() -> None:
    result = nw.run(rows, seed=1)
    again = result.regrow("k[1]", particles=5, seed=2).best.choices
    changed = {path for path, value in result.best.choices.items() if again[path] != value}
    assert changed == {path for path in again if path.startswith("k[1]/")}
    with pytest.raises(InputError) as caught:
        result.regrow("**/k[1]", particles=5)
    assert caught.value.code == "many-parts"


def test_what_cannot_be_held_has_a_message() -> None:
    for hold, code in (
        ({"lenght": 1}, "no-address"),
        ({"count": 1, f"{leg_of(1)}/length": 1}, "everything-impossible"),
        ({"count": 7}, "everything-impossible"),
        ({"count": [1.0]}, "everything-impossible"),
        ({"count": "one"}, "type-mismatch"),
        ({"count": object()}, "bad-setting"),
        ([("count", 1)], "bad-setting"),
        (3, "bad-setting"),
        ("count", "hold-without-run"),
        (["count"], "hold-without-run"),
    ):
        with pytest.raises(NiwakiError) as caught:
            nw.run(legs, nw.smc(particles=20), seed=1, hold=hold)  # type: ignore[arg-type]
        assert caught.value.code == code
    with pytest.raises(InputError, match="did not make it"):
        nw.run(legs, nw.smc(particles=20), seed=1, hold={"count": 1, f"{leg_of(1)}/length": 1})


def test_hold_means_the_same_in_every_search_and_drag() -> None:
    first = nw.run(legs, nw.smc(particles=20), seed=1).best
    leg = f"{leg_of(0)}/length"
    expected = first.held(leg)
    assert list(expected) == [leg]
    # An address, a pattern, several, and values by address hold the same.
    for hold in (leg, [leg], expected, {leg: first.choices[leg]}):
        search = nw.Search(legs, method=nw.mh(20), seed=2, choices=first.choices, hold=hold)
        assert search.held == expected and search.hash == replace(search, hold=expected).hash
        assert replace(search, choices=None).held == expected
        assert expected.items() <= search.run().best.choices.items()
    assert nw.Search(legs, choices=first.choices, hold=["count", leg]).held == first.held("count", leg)
    with pytest.raises(InputError, match="no-address|matches no"):
        nw.Search(legs, choices=first.choices, hold="hat")


#: Models that differ: bodies in a loop, a recursion, blocks that stand on each other, a town, a coral.
MODELS = ("spaceship", "gnarly_tree", "toy_blocks", "downtown", "coral")


def hold_at_random(name: str, seed: int) -> str:
    """Holds a part or some choices of a run, and searches: what came of it."""
    rng, model = random.Random(seed), entry(name)
    assert model is not None
    target = model.target()
    score = (
        nw.no_self_intersection() * nw.match_volume(target, model.voxel)
        if target
        else nw.no_self_intersection()
    )
    free = nw.run(model.model, seed=seed).best
    paths = list(free.choices)
    calls = sorted({path.rpartition("/")[0] for path in paths} - {""})
    pool = calls if calls and rng.random() < 0.5 else paths
    hold = free.held(*rng.sample(pool, min(len(pool), rng.randint(1, 3))))
    method = rng.choice([nw.smc(particles=20), nw.smc(particles=20, order="depth-first"), nw.mh(50, thin=10)])
    start = free.choices if isinstance(method, nw.methods.Mh) else None
    try:
        result = nw.run(model.model, method, score=score, seed=seed, hold=hold, choices=start)
    except InputError as error:
        assert error.code in ("everything-impossible", "no-start"), str(error)
        return error.code
    alive = [sample for sample in result if sample.log_weight > -math.inf and sample.log_score > -math.inf]
    for sample in alive[:6]:
        assert {path: sample.choices.get(path) for path in hold} == hold, f"{name}, seed {seed}"
    return "held" if alive else "everything-impossible"


def test_random_locks_are_held_to_the_bit() -> None:
    outcomes = Counter(hold_at_random(MODELS[seed % 5], seed) for seed in range(20))
    assert outcomes["held"] > 5, outcomes


@pytest.mark.soak
def test_a_thousand_random_locks_are_held_to_the_bit() -> None:
    first = int(os.environ.get("NIWAKI_SEED", secrets.randbelow(2**31)))
    print(f"NIWAKI_SEED={first}")
    outcomes: dict[str, Counter[str]] = {name: Counter() for name in MODELS}
    for number in range(1000):
        name = MODELS[number % 5]
        outcomes[name][hold_at_random(name, first + number)] += 1
    print(outcomes)
    assert sum(counts["held"] for counts in outcomes.values()) > 250
