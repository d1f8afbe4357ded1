"""A search for the best spends a floor of work, restarts where it stands still, and ends where nothing can rise.

No clock decides.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import niwaki as nw
import pytest
from niwaki import box, categorical, emit, factor, host, uniform
from niwaki.methods import Improve
from niwaki.methods.improve import VARIABLE
from niwaki.result import Result
from niwaki.targets.examples.lofts import block, solid

#: Instructions of the floor, and of a call of a function of the host.
FLOOR, HOST = 3_000_000_000, 3_000_000
#: The least gain that counts, nats.
GAIN = 0.01

#: The calls of `heard`.
CALLS = [0]


@host
def heard(x: float) -> float:
    """Return the height at a place: a broad hill, and a narrow one that is higher."""
    CALLS[0] += 1
    return max(1.0 - abs(x - 0.2), 3.0 - 40.0 * abs(x - 0.9))


@nw.model
def hills() -> float:
    """A place on two hills, which the host knows."""
    x = uniform(0.0, 1.0)
    y = uniform(0.0, 1.0)
    factor(4.0 * heard(x) - y)
    return x


@nw.model
def beam() -> None:
    """A beam of one of three lengths."""
    length = categorical([0.7, 0.2, 0.1])
    emit(box((0.5 * (length + 1), 0.5, 0.5), (length + 1, 1.0, 1.0)))


@nw.model
def judged_beam() -> None:
    """A beam of one of three lengths, with a factor of its own."""
    length = categorical([0.7, 0.2, 0.1])
    factor(0.0)
    emit(box((0.5 * (length + 1), 0.5, 0.5), (length + 1, 1.0, 1.0)))


@pytest.fixture(autouse=True)
def usual_default(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Searches end as they do for users."""
    monkeypatch.delenv(VARIABLE, raising=False)
    return


def climbed(seed: int = 1, threads: int = 1, **settings: Any) -> Result:
    """Climb the hills with few particles."""
    return nw.run(
        hills, method=nw.improve(particles=20, regrow=4, power=1.0, **settings), seed=seed, threads=threads
    )


def is_done(rounds: list[Any], price: int, effort: float) -> bool:
    """Whether a search with these rounds, after its starts, has spent its floor and stands still as documented."""
    idle = 0
    for before, step in zip(rounds, rounds[1:], strict=False):
        has_moved = step.step == "restart" or step.best - before.best >= GAIN
        idle = 0 if has_moved else idle + step.work
    total = sum(step.work for step in rounds)
    patience = max(2 * rounds[0].work, FLOOR // 4 // price)
    share = min(1.0, effort)
    return len(rounds) - 1 >= 15 * share and total * price >= FLOOR * effort and idle >= patience * share


@pytest.mark.parametrize("effort", [0.4, 0.5])
def test_a_floor_of_work_is_spent_before_a_search_ends(effort: float) -> None:
    info = climbed(effort=effort).info
    rounds = list(info.rounds)
    last = max(place for place, each in enumerate(rounds) if each.step == "restart")
    starts = sum(each.work for each in rounds[:last])
    assert FLOOR // 4 < starts * info.price < FLOOR // 2 and info.price > HOST
    assert is_done(rounds, info.price, effort)
    assert not any(is_done(rounds[:count], info.price, effort) for count in range(1, len(rounds)))
    assert sum(info.spent.values()) == sum(step.work for step in rounds) * info.price >= FLOOR * effort


def test_the_floor_of_a_dear_host_is_a_thousand_calls() -> None:
    CALLS[0] = 0
    info = climbed().info
    assert 500 < CALLS[0] < 4000
    assert sum(step.work for step in info.rounds) * HOST < 3 * FLOOR


def test_a_search_that_stands_still_restarts_and_keeps_the_best() -> None:
    result = climbed(effort=3.0)
    info = result.info
    assert info.restarts >= 1 and "restart" in info.bill
    bests = [step.best for step in info.rounds]
    assert bests == sorted(bests) and result.best.log_score == bests[-1]


def test_restarts_follow_from_work_alone() -> None:
    whole = climbed(effort=3.0)
    again = climbed(rounds=len(whole.info.rounds) - 1, threads=2)
    assert again.info == whole.info and again.best.choices == whole.best.choices
    timed = climbed(seconds=0.2)
    assert (
        timed.info == climbed(rounds=max(len(timed.info.rounds) - 1, 1)).info or len(timed.info.rounds) == 1
    )


def test_a_search_ends_where_all_cells_are_right() -> None:
    target = solid("beam", [block((0.0, 0.0, 0.0), (3.0, 1.0, 1.0))])
    result = nw.grow(beam, target, voxel=0.25, seed=1)
    assert result.best.similarity == 1.0
    assert len(result.info.rounds) == 1 and sum(result.info.spent.values()) < FLOOR / 100
    # A factor could be higher in another run.
    longer = nw.grow(judged_beam, target, voxel=0.25, seed=1, effort=0.01)
    assert longer.best.similarity == 1.0 and len(longer.info.rounds) > 1


def test_rounds_are_the_default_where_the_environment_names_them(monkeypatch: pytest.MonkeyPatch) -> None:
    assert (nw.improve().rounds, nw.improve().effort) == (None, 1.0)
    monkeypatch.setenv(VARIABLE, "7")
    assert nw.improve().rounds == 7
    assert [nw.improve(effort=0.5).rounds, nw.improve(seconds=1).rounds, nw.improve(rounds=3).rounds] == [
        None,
        None,
        3,
    ]
    monkeypatch.setenv(VARIABLE, "few")
    with pytest.raises(nw.InputError, match=VARIABLE):
        nw.improve()


def test_a_stored_search_without_effort_has_fifteen_rounds() -> None:
    data = nw.improve().data(lambda _: None)
    assert Improve.of_data(data, lambda _: None).rounds is None
    del data["effort"]
    assert Improve.of_data(data, lambda _: None).rounds == 15
    assert Improve.of_data(data | {"rounds": 3}, lambda _: None).rounds == 3


def test_the_bill_has_the_work_by_kind_of_step() -> None:
    info = climbed(rounds=6).info
    assert set(info.spent) == {each.step for each in info.rounds}
    assert "in 6 rounds" in info.bill and ("restart" in info.bill) == (info.restarts > 0)
