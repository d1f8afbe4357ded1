"""Claim: models with a target run in plain Python and on the engine, and grow; free ships are the dissertation's.

Rates of false alarms, each for a fresh seed, under the null that the published facts hold: the number of primitives is
off by more than 4 standard errors in 6e-5 of the cases; a share of 0.32 in 600 samples has a standard error of 0.019,
so that it is off by more than 0.06 in 2e-3, which is why the seed is fixed.
"""

from __future__ import annotations

import math
from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from niwaki.draw.scene import Scene
from niwaki.gallery import Entry, entries, entry, vines
from niwaki.gallery.spaceship import spaceship
from niwaki.shell.demo import demo
from niwaki.targets import drawings

GALLERY = [one for one in entries() if one.target_name is not None]
DRAWERS = [one for one in entries() if one.draws is not None]
FEW = 60


def named(one: Entry) -> str:
    return one.name


@pytest.mark.parametrize("one", [*GALLERY, *DRAWERS], ids=named)
def test_lowers_and_runs(one: Entry) -> None:
    assert one.title and "\n" not in one.title
    assert one.model.core().text.startswith("(module")
    result = nw.run(one.model, method=nw.forward(20), seed=1)
    assert len(result) == 20
    assert all(sample.has_ended and sample.primitives > 0 for sample in result)


@pytest.mark.parametrize("one", [*GALLERY, *DRAWERS], ids=named)
def test_plain_python_makes_the_same_scene(one: Entry) -> None:
    here = nw.run(one.model, seed=4).best
    plain = nw.run_python(one.model, choices=here.choices)
    assert plain.log_prior == pytest.approx(here.log_prior, rel=1e-12)
    scene = Scene(plain.scene)
    assert [part.address for part in scene] == [part.address for part in here.scene]
    assert [len(part.shapes) for part in scene] == [len(part.shapes) for part in here.scene]
    assert np.allclose(scene.merged()[0], here.scene.merged()[0], atol=1e-9)


@pytest.mark.filterwarnings("ignore:the best result is an empty scene")
@pytest.mark.parametrize("one", GALLERY, ids=named)
def test_grows_and_grows_again(one: Entry) -> None:
    target = one.target()
    assert target is not None
    nothing = nw.grow(empty, target, particles=1, voxel=one.voxel, seed=1).best
    first = nw.grow(one.model, target, particles=FEW, voxel=one.voxel, runs=3, seed=1)
    again = nw.grow(one.model, target, particles=FEW, voxel=one.voxel, runs=3, seed=1, threads=1)
    assert [sample.choices for sample in first] == [sample.choices for sample in again]
    assert [sample.log_score for sample in first] == [sample.log_score for sample in again]
    for sample in first:
        assert sample.has_ended
        assert sample.log_score > nothing.log_score + 5.0


@pytest.mark.filterwarnings("ignore:the best result is an empty scene")
@pytest.mark.parametrize("one", DRAWERS, ids=named)
def test_draws_and_draws_again(one: Entry) -> None:
    assert one.window is not None
    if one.score is None:
        assert one.drawing_name is not None
        drawing = drawings.drawing(one.drawing_name)
        score, start = drawing.score(one.window), drawing.place(one.window)
    else:
        score, start = one.score(), ()
    first = nw.grow(one.model, None, *start, score=score, particles=100, runs=2, seed=1)
    again = nw.grow(one.model, None, *start, score=score, particles=100, runs=2, seed=1, threads=1)
    assert [(sample.log_score, sample.choices) for sample in first] == [
        (sample.log_score, sample.choices) for sample in again
    ]
    empty_page = nw.grow(empty, None, score=score, particles=1, seed=1).best
    assert first.best.log_score > empty_page.log_score + 100.0


def test_vines_follow_letters_as_the_dissertation_says() -> None:
    """A median similarity of about 0.8 with 600 particles (6.5.2): of ten glyphs above 0.6, and none is a stump."""
    names = drawings.names("glyphs")[::20]
    found = []
    for seed, name in enumerate(names):
        one = drawings.drawing(name)
        start, score = one.place(vines.WINDOW), one.score(vines.WINDOW)
        best = nw.grow(
            vines.vines, None, *start, score=score, particles=600, resampling="tempered", seed=seed
        ).best
        found.append(best.similarity or 0.0)
    assert np.median(found) > 0.6 and min(found) > 0.1


def test_the_tree_fills_most_of_its_target() -> None:
    """A designer's bar, not a theorem: with the shell's population each of ten trees is one to show."""
    one = entry("niwaki-tree")
    assert one is not None
    target = one.target()
    assert target is not None
    trees = nw.grow(one.model, target, particles=300, voxel=one.voxel, runs=10, seed=1)
    assert min(sample.similarity or 0.0 for sample in trees) > 0.9
    assert len({round(sample.log_score, 6) for sample in trees}) == 10


def test_ships_have_as_many_primitives_as_published() -> None:
    """Dissertation 5.5: 16.35 on average; 6.4 is the standard deviation of our own forward runs."""
    counts = [sample.primitives for sample in nw.run(spaceship, method=nw.forward(400), seed=1)]
    assert abs(sum(counts) / 400 - 16.35) < 4.0 * 6.4 / math.sqrt(400)


def test_a_third_of_the_ships_run_through_themselves() -> None:
    """By the rule of surfaces, touching too: 0.32 of the forward runs."""
    score = nw.no_self_intersection("surface")
    ships = nw.run(spaceship, method=nw.importance(600), score=score, seed=1)
    share = sum(sample.log_score == -math.inf for sample in ships) / 600
    assert abs(share - 0.32) < 0.06


def test_the_demo_leaves_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("niwaki.shell.demo.RUNS", 2)
    demo(tmp_path)
    for one in GALLERY:
        for name in ("best.glb", "best.png", "sheet.png", "run.json"):
            assert (tmp_path / one.name / name).stat().st_size > 0, f"{one.name}/{name}"


@nw.model
def empty():  # type: ignore[no-untyped-def]
    """The empty scene."""
