"""Claim: models with a target run in plain Python and on the engine, and grow; free ships agree with the dissertation.

Rates of false alarms, each for a fresh seed, under the null that the published facts hold: the number of primitives is
off by more than 4 standard errors in 6e-5 of the cases; a share of 0.32 in 600 samples has a standard error of 0.019,
so that it is off by more than 0.06 in 2e-3, which is why the seed is fixed.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.draw.scene import Scene
from niwaki.gallery import FIRST, Entry, entries, entry, vines
from niwaki.gallery.spaceship import spaceship
from niwaki.shell.demo import demo
from niwaki.targets import drawings

GALLERY = [gallery_entry for gallery_entry in entries() if gallery_entry.target_name is not None]
DRAWERS = [gallery_entry for gallery_entry in entries() if gallery_entry.draws is not None]
FEW = 60


def named(gallery_entry: Entry) -> str:
    return gallery_entry.name


@pytest.mark.parametrize("gallery_entry", [*GALLERY, *DRAWERS], ids=named)
def test_models_compile_and_run(gallery_entry: Entry) -> None:
    assert gallery_entry.title and "\n" not in gallery_entry.title
    assert gallery_entry.model.core().text.startswith("(module")
    result = nw.run(gallery_entry.model, method=nw.forward(20), seed=2)
    assert len(result) == 20
    assert all(sample.has_ended and sample.primitives > 0 for sample in result)


@pytest.mark.parametrize("gallery_entry", [*GALLERY, *DRAWERS], ids=named)
def test_plain_python_makes_the_same_scene(gallery_entry: Entry) -> None:
    here = nw.run(gallery_entry.model, seed=4).best
    plain = nw.run_python(gallery_entry.model, choices=here.choices)
    assert plain.log_prior == pytest.approx(here.log_prior, rel=1e-12)
    scene = Scene(plain.scene)
    assert [part.address for part in scene] == [part.address for part in here.scene]
    assert [len(part.shapes) for part in scene] == [len(part.shapes) for part in here.scene]
    assert np.allclose(scene.merged()[0], here.scene.merged()[0], atol=1e-9)


@pytest.mark.filterwarnings("ignore:the best result is an empty scene")
@pytest.mark.parametrize("gallery_entry", GALLERY, ids=named)
def test_models_grow_the_same_result_again(gallery_entry: Entry) -> None:
    target = gallery_entry.target()
    assert target is not None
    empty_scene = nw.grow(empty, target, particles=1, voxel=gallery_entry.voxel, seed=1).best
    # The first models have many kinds, which the default search visits and few particles do not.
    is_first = gallery_entry.name in FIRST
    effort: dict[str, int] = {"rounds": 8, "runs": 1} if is_first else {"particles": FEW, "runs": 3}
    settings: dict[str, Any] = {"voxel": gallery_entry.voxel, "seed": 1, **effort}
    first = nw.grow(gallery_entry.model, target, **settings)
    again = nw.grow(gallery_entry.model, target, threads=1, **settings)
    assert [sample.choices for sample in first] == [sample.choices for sample in again]
    assert [sample.log_score for sample in first] == [sample.log_score for sample in again]
    for sample in first:
        assert sample.has_ended
        assert sample.log_score > empty_scene.log_score + 5.0


@pytest.mark.filterwarnings("ignore:the best result is an empty scene")
@pytest.mark.parametrize("gallery_entry", DRAWERS, ids=named)
def test_drawing_models_draw_the_same_result_again(gallery_entry: Entry) -> None:
    assert gallery_entry.window is not None
    if gallery_entry.score is None:
        assert gallery_entry.drawing_name is not None
        drawing = drawings.drawing(gallery_entry.drawing_name)
        score, start = drawing.score(gallery_entry.window), drawing.place(gallery_entry.window)
    else:
        score, start = gallery_entry.score(), ()
    first = nw.grow(gallery_entry.model, None, *start, score=score, particles=100, runs=2, seed=1)
    again = nw.grow(gallery_entry.model, None, *start, score=score, particles=100, runs=2, seed=1, threads=1)
    assert [(sample.log_score, sample.choices) for sample in first] == [
        (sample.log_score, sample.choices) for sample in again
    ]
    empty_page = nw.grow(empty, None, score=score, particles=1, seed=1).best
    assert first.best.log_score > empty_page.log_score + 100.0


def test_vines_follow_letters_as_the_dissertation_says() -> None:
    """A median similarity of about 0.8 with 600 particles (6.5.2): of ten glyphs above 0.6, and none is a stump."""
    names = drawings.names("glyphs")[::20]
    similarities = []
    for seed, name in enumerate(names):
        drawing = drawings.drawing(name)
        start, score = drawing.place(vines.WINDOW), drawing.score(vines.WINDOW)
        best = nw.grow(
            vines.vines, None, *start, score=score, particles=600, resampling="tempered", seed=seed
        ).best
        similarities.append(best.similarity or 0.0)
    assert np.median(similarities) > 0.6 and min(similarities) > 0.1


def test_the_tree_fills_most_of_its_target() -> None:
    """Require a similarity above 0.9 for ten trees with the shell's population; a standard of design, not a theorem."""
    tree = entry("niwaki-tree")
    assert tree is not None
    target = tree.target()
    assert target is not None
    trees = nw.grow(tree.model, target, particles=300, voxel=tree.voxel, runs=10, seed=1)
    assert min(sample.similarity or 0.0 for sample in trees) > 0.9
    assert len({round(sample.log_score, 6) for sample in trees}) == 10


def test_ships_have_as_many_primitives_as_published() -> None:
    """Dissertation 5.5: 16.35 on average; 6.4 is the standard deviation of our own forward runs."""
    counts = [sample.primitives for sample in nw.run(spaceship, method=nw.forward(400), seed=1)]
    assert abs(sum(counts) / 400 - 16.35) < 4.0 * 6.4 / math.sqrt(400)


def test_a_third_of_the_ships_intersect_themselves() -> None:
    """By the rule of surfaces, touching too: 0.32 of the forward runs."""
    score = nw.no_self_intersection("surface")
    ships = nw.run(spaceship, method=nw.importance(600), score=score, seed=1)
    share = sum(sample.log_score == -math.inf for sample in ships) / 600
    assert abs(share - 0.32) < 0.06


def test_the_demo_leaves_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    without = next(gallery_entry for gallery_entry in entries() if gallery_entry.target_name is None)
    ship = entry("simple-ship")
    assert ship is not None
    some = [without, ship]
    monkeypatch.setattr("niwaki.shell.demo.RUNS", 2)
    monkeypatch.setattr("niwaki.shell.demo.entries", lambda: some)
    demo(tmp_path)
    assert [folder.name for folder in tmp_path.iterdir()] == [ship.name]
    for name in ("best.glb", "best.png", "sheet.png", "run.json"):
        assert (tmp_path / ship.name / name).stat().st_size > 0, name


@nw.model
def empty():  # type: ignore[no-untyped-def]
    """The empty scene."""
