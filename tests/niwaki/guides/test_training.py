"""Claim: training gives the same bytes on any number of threads, can be stopped at any moment and gone on with, and
leaves out what fails.
"""

from __future__ import annotations

import _thread
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import niwaki as nw
import pytest
from bars import PAGES
from niwaki import guides
from niwaki.errors import InputError, ModelFault
from niwaki.guides import Round, Training, train_guide
from niwaki.methods import smc
from niwaki.words import choose, emit, flip, gaussian, look, stroke

WINDOW = ((-2.0, -1.0), (2.0, 3.0))
FAST = Training(steps=80, hidden=(8, 8))
SEARCHES = (smc(20), smc(10, resampling="tempered"))


@nw.model
def path():  # type: ignore[no-untyped-def]
    """Two or three strokes, each to the left or to the right."""
    step(0.0, -0.6, 0)


@nw.model
def step(x, y, depth):  # type: ignore[no-untyped-def]
    """One stroke, and perhaps another."""
    look((x, y), (0.0, 1.0))
    aside = choose([-0.9, 0.9])
    tall = gaussian(1.0, 0.1)
    emit(stroke((x, y, 0.0), (x + aside, y + tall, 0.0), 0.7, 0.4))
    if depth < 1 or (depth < 3 and flip(0.5)):
        step(x + aside, y + tall, depth + 1)
    elif depth > 9:
        flip(0.3)


@nw.model
def broken():  # type: ignore[no-untyped-def]
    """Divides by zero."""
    return 1.0 / (gaussian(0.0, 1.0) * 0.0)


def trained(**settings: Any) -> nw.Guide:
    defaults: dict[str, Any] = {
        "rounds": (12, 12),
        "searches": SEARCHES,
        "training": FAST,
        "seed": 1,
        "keep": lambda sample: sample.has_ended,
    }
    return train_guide(
        path, PAGES, lambda page: nw.match_drawing(page, WINDOW, sigma=0.3), **defaults | settings
    )


@pytest.fixture(scope="module")
def guide() -> nw.Guide:
    return trained()


def test_the_bytes_depend_on_the_seed_and_not_on_the_threads(guide: nw.Guide) -> None:
    assert trained(threads=1).data == trained(threads=2).data == guide.data
    assert trained(seed=2).data != guide.data


def test_the_report_says_how_it_was_made(guide: nw.Guide) -> None:
    report = guide.report
    assert (report["seed"], report["targets"], report["held_out"], report["interrupted"]) == (1, 5, 1, False)
    assert report["training"]["hidden"] == [8, 8] and report["training"]["share"] == 0.02
    first, second = report["rounds"]
    assert first["traces"] == second["traces"] == 12 and first["failed"] == 0
    assert first["losses"][-1][0] == 80 and len(first["scores"]) == len(first["similarities"]) == 1
    assert first["summary"]["mean"] == pytest.approx(first["similarities"][0])


def test_a_choice_that_no_trace_visited_is_listed(guide: nw.Guide) -> None:
    lines = guide.show().splitlines()
    assert sum("drawn from its prior, because no trace visited it" in line for line in lines) == 1
    assert sum("in the traces" in line for line in lines) == 3


def test_it_goes_on_with_a_guide(guide: nw.Guide) -> None:
    more = trained(start=guide, rounds=(12,), seed=3)
    assert more.data != guide.data
    before, after = more.report["rounds"][0], more.report["rounds"][-1]
    assert before["number"] == -1 and before["scores"] == guide.report["rounds"][-1]["scores"]
    # A guide without traces has a loss near zero at its first step.
    assert abs(guide.report["rounds"][0]["losses"][0][1]) < 0.05 and after["losses"][0][1] < -0.1


def pressing(when: Callable[[Round], bool]) -> Callable[[Round], None]:
    def progress(now: Round) -> None:
        if when(now):
            raise KeyboardInterrupt

    return progress


def test_ctrl_c_keeps_the_best_so_far(guide: nw.Guide) -> None:
    first = trained(rounds=(12,))
    searching = trained(progress=pressing(lambda now: now.number == 1 and now.traces == 3))
    learning = trained(progress=pressing(lambda now: now.number == 1 and now.steps > 0))
    for stopped in (searching, learning):
        assert stopped.report["interrupted"] and len(stopped.report["rounds"]) == 1
        assert unreported(stopped) == unreported(first)
    early = trained(progress=pressing(lambda now: now.step == 80))
    assert early.report["interrupted"] and early.report["rounds"][0]["scores"] == []
    unchanged = trained(start=guide, progress=pressing(lambda now: now.traces == 1))
    assert unreported(unchanged) == unreported(guide) and unchanged.report["interrupted"]
    with pytest.raises(KeyboardInterrupt):
        trained(progress=pressing(lambda now: now.traces == 3))


def unreported(guide: nw.Guide) -> bytes:
    """The bytes of a guide without its report."""
    return guide.with_report({}).data


def test_ctrl_c_drops_the_searches_that_wait() -> None:
    start, timer = time.monotonic(), threading.Timer(0.5, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        trained(rounds=(5000,), searches=(smc(2000),))
    # The searches that wait would take many minutes.
    assert time.monotonic() - start < 60.0


def test_what_fails_is_left_out() -> None:
    shown: list[Round] = []
    guide = trained(
        rounds=(12,), keep=lambda sample: sample.value is None and shown_even(shown), progress=shown.append
    )
    last = guide.report["rounds"][0]
    assert last["traces"] + last["failed"] == 12 and last["failed"] > 0
    with pytest.raises(InputError) as error:
        trained(keep=lambda sample: False)
    assert error.value.code == "guide-traces"


def test_a_model_that_fails_always_shows_its_fault() -> None:
    with pytest.raises(ModelFault, match="division-by-zero"):
        train_guide(
            broken, PAGES, lambda page: nw.match_drawing(page, WINDOW), rounds=(4,), searches=SEARCHES, seed=1
        )


def shown_even(shown: list[Round]) -> bool:
    """Every second one."""
    return len(shown) % 2 == 0


def test_training_that_leaves_the_numbers_keeps_the_weights_before() -> None:
    with pytest.warns(nw.search.SearchWarning, match=r"not finite in step \d+.*are kept"):
        guide = trained(rounds=(12,), training=replace(FAST, rate=1e38))
    assert guide.report["rounds"][0]["scores"]


@pytest.mark.parametrize("bad", [{"share": 0.0}, {"rate": float("inf")}, {"hidden": (3,)}, {"batch": 0}])
def test_settings_are_checked(bad: dict[str, Any]) -> None:
    with pytest.raises(InputError, match="bad-setting"):
        Training(**bad)


@pytest.mark.parametrize(
    "bad", [{"rounds": ()}, {"rounds": (1,)}, {"start": 3}, {"searches": ()}, {"seed": -1}]
)
def test_arguments_are_checked(bad: dict[str, Any]) -> None:
    with pytest.raises(InputError, match="bad-setting"):
        trained(**bad)


def test_a_round_is_summed_up() -> None:
    now = Round(0, similarities=[0.05, 0.5, 0.9], scores=[-3.0, -2.0, -1.0])
    assert now.summary() == pytest.approx({"mean": 1.45 / 3, "median": 0.5, "p10": 0.14, "stumps": 1 / 3})
    assert guides.report.sentence(now.summary()) == "mean 0.483, median 0.500, worst tenth 0.140, stumps 33 %"
