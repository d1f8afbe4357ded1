"""Claim: the shares of a fit are those of the shapes, and neither nothing nor too much looks good."""

from __future__ import annotations

import niwaki as nw
import numpy as np
import pytest
from niwaki import box, cylinder
from niwaki.draw.scene import Scene
from niwaki.search import SearchWarning
from niwaki.targets.fit import Fit, cells, fit

TARGET = nw.Target.of_shapes(box((0, 2, 0), (2, 4, 2)))
SCORE = nw.match_volume(TARGET, 0.1)

#: A layer of cells, as a share of the target.
CELL = 0.1 / 2.0


def of(*shapes: nw.Shape) -> Fit:
    measure = fit(SCORE, Scene([(f"{k}", [shape]) for k, shape in enumerate(shapes)]))
    assert measure is not None
    return measure


def test_shares_of_a_volume_are_those_of_boxes() -> None:
    assert of() == Fit(0.0, 0.0)
    assert of(box((0, 2, 0), (2, 4, 2))) == Fit(1.0, 0.0)
    # The lower half, then a half of which a half sticks out through the target's side, beyond the grid.
    lower = of(box((0, 1, 0), (2, 2, 2)))
    assert lower.covered == pytest.approx(0.5, abs=CELL) and lower.outside == 0.0
    half = of(box((1, 2, 0), (2, 4, 2)))
    assert half.covered == pytest.approx(0.5, abs=CELL) and half.outside == pytest.approx(0.5, abs=CELL)
    # Parts that overlap count once.
    assert of(box((0, 1, 0), (2, 2, 2)), box((0, 1, 0), (2, 2, 2))) == lower


def test_a_scene_that_is_far_away_or_huge_is_outside() -> None:
    assert of(box((50, 2, 0), (2, 4, 2))) == Fit(0.0, 1.0)
    huge = of(box((0, 0, 0), (400, 400, 400)))
    assert huge.covered == 1.0 and huge.outside > 0.999


def test_shares_do_not_depend_on_which_cells_the_score_counts() -> None:
    scene = Scene([("part", [box((1, 1, 0), (2, 2, 2))])])
    assert fit(nw.match_volume(TARGET, 0.1, weight="balanced"), scene) == fit(SCORE, scene)


def test_an_empty_scene_agrees_with_much_and_covers_nothing() -> None:
    result = nw.Search(nothing, score=SCORE).run()
    assert result.best.similarity is not None and result.best.similarity >= 0.0
    assert result.best.fit == Fit(0.0, 0.0)
    assert ", 0 % covered" in repr(result.best)


@nw.model
def nothing():
    return 0


def test_pixels_and_rounding() -> None:
    target, scene = np.zeros((10, 10), bool), np.zeros((10, 10), bool)
    target[:5], scene[3:8] = True, True
    assert Fit.of_masks(target, scene) == Fit(0.4, 0.6)
    assert Fit.of_masks(target, ~target & target) == Fit(0.0, 0.0)
    # Nearly all is not all, and nearly nothing is not nothing.
    assert str(Fit(0.99999, 0.00001)) == "99 % covered, 1 % outside"
    assert str(Fit(1.0, 0.0)) == "100 % covered, 0 % outside"


@nw.model
def block(x, size):
    nw.emit(box((x, size * nw.uniform(0.4, 0.6), 0), (size, size, size)))


@pytest.mark.parametrize(
    ("x", "size", "text"),
    [(0.0, 60.0, "15 times as large as the target"), (100.0, 2.0, "far from where the model begins")],
)
def test_another_unit_and_another_place_are_warnings(x: float, size: float, text: str) -> None:
    with pytest.warns(SearchWarning) as caught:
        nw.grow(block, TARGET, x, size, particles=5, seed=1, voxel=0.5)
    assert any(text in str(warning.message) for warning in caught)


def test_a_result_without_a_scene_is_a_warning() -> None:
    with pytest.warns(SearchWarning, match="the best result is an empty scene"):
        nw.grow(nothing, TARGET, particles=5, seed=1, voxel=0.5)


def test_cells_are_those_that_the_score_counts() -> None:
    shapes = [
        box((0.3, 1, 0), (2, 2, 2)),
        cylinder((0.1, 2, 0), 0.8, 4.4, "y", 0.5),
        box((9, 9, 9), (1, 1, 1)),
    ]
    scene = Scene([(f"{k}", [shape]) for k, shape in enumerate(shapes)])
    grid = cells(SCORE, scene)
    assert grid is not None
    inside = int((grid.scene & grid.target).sum())
    assert of(*shapes).covered == inside / int(grid.target.sum())
    sketch = nw._engine.Sketch(SCORE.specs)
    for shape in shapes:
        sketch.add([shape])
    assert sketch.measures()["filled"] == grid.scene.sum()
    assert sketch.similarity() == 1.0 - (grid.scene != grid.target).sum() / grid.scene.size


def test_the_cells_of_a_box_are_those_that_it_touches() -> None:
    grid = cells(SCORE, Scene([("0", [box((0.5, 1, 0), (0.46, 0.94, 0.46))])]))
    assert grid is not None
    step = (grid.high - grid.low) / grid.scene.shape
    edges = [
        low + size * np.arange(n + 1) for low, size, n in zip(grid.low, step, grid.scene.shape, strict=True)
    ]
    touched = [
        (e[:-1] <= b) & (e[1:] >= a)
        for e, a, b in zip(edges, (0.27, 0.53, -0.23), (0.73, 1.47, 0.23), strict=True)
    ]
    assert np.array_equal(grid.scene, np.einsum("x,y,z->xyz", *touched))
