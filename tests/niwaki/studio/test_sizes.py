"""The worker's part of a sketch and of a target: outlines and their inside; sizes, axes and places that fit."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("starlette")

import numpy as np
import trimesh
from niwaki.shell.references import find
from niwaki.studio import messages as m
from niwaki.studio.worker import asks, fitting, models, prior

HOUSE = [(0.3, 0.8), (0.3, 0.5), (0.5, 0.3), (0.7, 0.5), (0.7, 0.8)]


def share(*strokes: list[tuple[float, float]], inside: bool = True) -> float:
    """The share of the picture that a sketch with these strokes means."""
    drawn = m.Sketch([m.Stroke(stroke, 0.02) for stroke in strokes], aspect=1.0, inside=inside)
    return float(asks.mask(drawn).mean())


def test_a_closed_outline_means_its_inside_and_an_open_stroke_itself() -> None:
    inside = 0.4 * 0.3 + 0.5 * 0.4 * 0.2
    assert share([*HOUSE, HOUSE[0]]) == pytest.approx(inside, abs=0.04)
    # A hand rarely meets the first point: an end near it closes the outline.
    assert share([*HOUSE, (0.33, 0.79)]) == pytest.approx(inside, abs=0.04)
    # Several strokes enclose as one does.
    assert share(HOUSE[:4], [HOUSE[3], HOUSE[4], HOUSE[0]]) == pytest.approx(inside, abs=0.04)
    for stroke in (HOUSE[:4], HOUSE[:2], [(0.2, 0.2), (0.8, 0.8)], [(0.5, 0.5)]):
        assert share(stroke) == share(stroke, inside=False) < 0.05
    assert share([*HOUSE, HOUSE[0]], inside=False) < 0.06


@pytest.fixture
def tower(tmp_path: Path) -> Path:
    """A model of one box, two wide and four high."""
    place = tmp_path / "tower.py"
    place.write_text(
        "from niwaki import box, emit, model, uniform\n\n\n@model\ndef tower(high=4.0):\n"
        "    emit(box((0.0, high / 2, 0.0), (uniform(1.9, 2.1), high, 2.0)))\n"
    )
    models.named[place.resolve()] = str(place)
    return place


def stored(tmp_path: Path, sides: tuple[float, float, float], at: tuple[float, float, float]) -> m.TargetAsk:
    """A box as the file of an upload."""
    mesh = trimesh.creation.box(sides)
    mesh.apply_translation(at)
    mesh.export(tmp_path / "sent.stl")
    asks._load.cache_clear()
    return m.TargetAsk(str((tmp_path / "sent.stl").resolve()))


@pytest.mark.parametrize(
    ("sides", "at", "labels"),
    [
        ((2.0, 4.0, 2.0), (0.0, 2.0, 0.0), []),
        ((2000.0, 4000.0, 2000.0), (0.0, 2000.0, 0.0), ["Scale to fit"]),
        ((0.02, 0.04, 0.02), (0.01, 0.0, 0.0), ["Scale to fit"]),
        ((2.0, 2.0, 4.0), (0.0, 0.0, 2.0), ["Stand it up"]),
        ((200.0, 200.0, 400.0), (0.0, 0.0, 200.0), ["Stand it up", "Scale to fit"]),
        ((2.0, 4.0, 2.0), (50.0, 2.0, 0.0), ["Move it here"]),
    ],
)
def test_an_offer_makes_the_target_fit(tower, tmp_path, sides, at, labels):
    ask = stored(tmp_path, sides, at)
    run = prior.run(models.reference(str(tower)), ())
    for number in range(len(labels) + 1):
        ghost, _ = asks.shown(ask)
        report = fitting.sizes(run, ask, ghost.bounds)
        assert [offer.label for offer in report.offers] == labels[number:]
        if report.offers:
            ask = report.offers[0].target
    assert report.target == pytest.approx((2.0, 4.0, 2.0), rel=0.03)
    low, high = ghost.bounds
    assert np.allclose([(low[0] + high[0]) / 2, low[1]], [0.0, 0.0], atol=0.1) or labels == ["Stand it up"]
    assert np.allclose(asks.placed(ask).bounds, ghost.bounds)


def test_a_run_of_a_model_is_the_same_each_time_and_a_model_without_one_has_no_size(tower, tmp_path):
    reference = models.reference(str(tower))
    first = prior.run(reference, ())
    prior._runs.clear()
    assert prior.run(reference, ()).choices == first.choices
    assert prior.run(reference, (8.0,)).scene.size[1] == pytest.approx(8.0)
    assert prior.run(find("gmm"), ()) is None
    assert fitting.sizes(None, None, None) == m.Sizes()
