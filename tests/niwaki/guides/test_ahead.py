"""Claim: a guide learns to look ahead from a seed on any number of threads, keeps that in its file and in the JSON of a
search, and changes no law by it; what cannot look ahead is refused.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from bars import PAGES
from niwaki.errors import InputError, ModelFault
from niwaki.guides import Training, train_guide, train_look_ahead
from niwaki.methods import particle_gibbs, pimh, smc
from niwaki.words import choose, emit, factor, flip, look, stroke

WINDOW = ((-2.0, -1.0), (2.0, 4.0))
TAUGHT: dict[str, Any] = {"searches": 60, "states": 3, "particles": 5, "seed": 1}


@nw.model
def path():  # type: ignore[no-untyped-def]
    """At most three strokes, each to the left or to the right."""
    return step(0.0, -0.6, 0)


@nw.model
def step(x, y, depth):  # type: ignore[no-untyped-def]
    """One stroke, and perhaps another."""
    look((x, y), (0.0, 1.0))
    aside = choose([-0.7, 0.7])
    emit(stroke((x, y, 0.0), (x + aside, y + 1.0, 0.0), 0.7, 0.4))
    look((x + aside, y + 1.0), (0.0, 1.0))
    if depth < 2 and flip(0.5):
        return 1 + step(x + aside, y + 1.0, depth + 1)
    return 1


@nw.model
def brittle(size):  # type: ignore[no-untyped-def]
    """Divides by zero in half of the runs, where the size is 2."""
    factor(1.0)
    if flip(0.5):
        factor(size / (2.0 - size))


def score(target: Any) -> nw.Score:
    return nw.match_drawing(target, WINDOW, sigma=0.4)


def taught(guide: nw.Guide, **more: Any) -> nw.Guide:
    return train_look_ahead(guide, path, PAGES, score, **TAUGHT | more)


@pytest.fixture(scope="module")
def plain() -> nw.Guide:
    fast = Training(steps=60, hidden=(8, 8))
    return train_guide(path, PAGES, score, rounds=(12,), searches=(smc(20),), training=fast, seed=1)


@pytest.fixture(scope="module")
def guide(plain: nw.Guide) -> nw.Guide:
    return taught(plain)


def test_the_bytes_depend_on_the_seed_and_not_on_the_threads(plain: nw.Guide, guide: nw.Guide) -> None:
    assert taught(plain, threads=1).data == taught(plain, threads=2).data == guide.data
    assert taught(plain, seed=2).data != guide.data
    assert guide.looks_ahead and not plain.looks_ahead


def test_the_report_says_how_well_it_was_learned(guide: nw.Guide, plain: nw.Guide) -> None:
    report = guide.report["look_ahead"]
    # Of six pages one judges, and a search has one to three barriers at which it still runs.
    assert report["rises"][0] > 2 * report["rises"][1] > 20 and sum(report["rises"]) <= 180
    assert (report["failed"], report["interrupted"], report["seed"]) == (0, False, 1)
    assert report["error"][1] < report["deviation"]
    assert {name: guide.report[name] for name in plain.report} == plain.report
    assert any(line.startswith("looks ahead") for line in guide.show().splitlines())


def test_it_is_kept_in_the_file_and_lost_where_the_network_changes(guide: nw.Guide, tmp_path: Any) -> None:
    guide.save(tmp_path / "path.guide")
    again = nw.methods.Guide.load(tmp_path / "path.guide")
    assert again == guide and again.form["ahead"] == guide.form["ahead"]
    # Where nothing judges, the guide that was given is not the answer.
    examples: dict[str, Any] = {"rounds": (12,), "searches": (smc(20),), "held_out": []}
    for training, more in (
        (Training(steps=5, hidden=(8, 8)), examples),
        (Training.bound(steps=5, hidden=(8, 8)), {}),
    ):
        on = train_guide(path, PAGES, score, start=guide, training=training, seed=3, **more)
        assert not on.looks_ahead


@pytest.mark.parametrize(
    "make",
    [
        lambda more: smc(8, resampling="tempered", **more),
        lambda more: particle_gibbs(4, 5, **more),
        lambda more: pimh(4, 5, **more),
    ],
)
def test_it_is_a_setting_and_goes_through_json(
    guide: nw.Guide, make: Callable[[dict[str, Any]], Any]
) -> None:
    method = make({"guide": guide, "look_ahead": 2})
    search = nw.Search(path, score=score(PAGES[0]), method=method, seed=3)
    again = nw.Search.of_json(search.json())
    assert again.method == method and again.method.look_ahead == 2.0  # type: ignore[attr-defined]
    other = replace(search, method=replace(method, look_ahead=None))
    assert again.hash == search.hash != other.hash
    first, second = search.run(), again.run()
    assert [sample.log_score for sample in first] == [sample.log_score for sample in second]


@pytest.mark.parametrize("strength", [0.2, 3.0])
@pytest.mark.parametrize("side", [0, 3])
def test_the_evidence_is_that_of_enumeration(guide: nw.Guide, strength: float, side: int) -> None:
    """Its mean over 600 seeds, within 5 standard errors: a false alarm once in 1.7 million, for each of four."""
    exact = nw.run(path, method=nw.enumerate_all(), score=score(PAGES[side]), seed=0).log_evidence
    assert exact is not None
    method = smc(6, resampling="tempered", guide=guide, look_ahead=strength)
    search = nw.Search(path, score=score(PAGES[side]), method=method)
    logs = [replace(search, seed=seed).run(threads=1).log_evidence for seed in range(600)]
    ratios = np.array([math.exp(log - exact) for log in logs if log is not None])
    assert len(ratios) == 600 and len(set(ratios)) > 100
    assert abs(ratios.mean() - 1.0) < 5 * ratios.std() / np.sqrt(600)


def test_a_line_in_the_score_alone_is_another_one(plain: nw.Guide, guide: nw.Guide) -> None:
    blind = taught(plain, looks=False)
    weights = blind.form["ahead"]["weights"]
    assert [k for k, weight in enumerate(weights) if weight] == [2, 3]
    assert blind.report["look_ahead"]["rises"] == guide.report["look_ahead"]["rises"]


def test_it_weighs_particles_on_their_way(guide: nw.Guide) -> None:
    near, far = (
        nw.run(path, method=smc(40, guide=guide, look_ahead=strength), score=score(PAGES[0]), seed=4)
        for strength in (None, 3.0)
    )
    assert [sample.log_score for sample in near] != [sample.log_score for sample in far]


def test_ctrl_c_learns_from_what_there_is(plain: nw.Guide) -> None:
    def progress(done: int, total: int) -> None:
        assert total == 100_000
        if done > 100:
            raise KeyboardInterrupt

    report = taught(plain, searches=100_000, progress=progress).report["look_ahead"]
    assert report["interrupted"] and 100 < sum(report["rises"]) < 100_000


def test_a_fault_is_shown_where_nothing_else_was_found() -> None:
    def on(sizes: list[float], start: nw.Guide | None) -> nw.Guide:
        defaults: dict[str, Any] = {
            "score": lambda _: nw.floor(0),
            "args": lambda target: (target,),
            "seed": 1,
        }
        if start is None:
            fast = Training.bound(steps=2, hidden=(8, 8))
            return train_guide(brittle, sizes, training=fast, **defaults)
        return train_look_ahead(start, brittle, sizes, searches=40, **defaults)

    guide = on([1.0, 1.5, 1.0], None)
    with pytest.raises(ModelFault, match="division-by-zero"):
        on([2.0, 2.0], guide)
    report = on([1.0, 1.0, 2.0], guide).report["look_ahead"]
    assert report["failed"] > 0 and report["rises"][0] > 20


def refused(make: Callable[[], Any]) -> str:
    with pytest.raises(InputError) as caught:
        make()
    return str(caught.value.code)


def test_what_makes_no_sense_is_refused(guide: nw.Guide, plain: nw.Guide) -> None:
    for strength in (0, -0.2, math.nan, math.inf, "much"):
        assert refused(lambda strength=strength: smc(10, guide=guide, look_ahead=strength)) == "bad-setting"  # type: ignore[misc]
    assert refused(lambda: smc(10, look_ahead=0.2)) == "guide-ahead"
    assert refused(lambda: pimh(10, guide=plain, look_ahead=0.2)) == "guide-ahead"
    moved: dict[str, Any] = {"guide": guide, "look_ahead": 0.2, "rejuvenate": nw.kernels.prior()}
    assert refused(lambda: smc(10, **moved)) == "bad-setting"
    assert smc(10, **moved, at="end").look_ahead == 0.2
    assert refused(lambda: taught(plain, method=smc(10, weights="absolute"))) == "bad-setting"
    assert refused(lambda: taught(plain, method=smc(10, guide=guide))) == "bad-setting"
    assert refused(lambda: taught(plain, searches=0)) == "bad-setting"
    assert refused(lambda: taught(plain, seed=-1)) == "bad-setting"
    assert refused(lambda: train_look_ahead(plain, path, PAGES[:1], score)) == "bad-setting"
    assert refused(lambda: train_look_ahead("vines.guide", path, PAGES, score)) == "bad-setting"  # type: ignore[arg-type]
    assert refused(lambda: taught(plain, searches=1)) == "guide-ahead"


def test_a_guide_of_another_model_is_refused(guide: nw.Guide) -> None:
    @nw.model
    def other():  # type: ignore[no-untyped-def]
        factor(1.0 if flip(0.5) else 0.0)

    method = smc(10, guide=guide, look_ahead=0.2)
    assert refused(lambda: nw.run(other, method=method, seed=1)) in ("guide-model", "guide-score")
    assert refused(lambda: train_look_ahead(guide, other, [1, 2], lambda _: nw.floor(0))) in (
        "guide-model",
        "guide-score",
    )


def test_the_network_of_the_dissertation_is_refused() -> None:
    fast = Training.dissertation(steps=2)
    guide = train_guide(path, PAGES, score, rounds=(4,), searches=(smc(20),), training=fast, seed=1)
    assert refused(lambda: taught(guide)) == "bad-setting"
