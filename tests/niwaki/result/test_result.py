"""A result says what was found: numbers in its repr, weights that sum to one, files and pictures of the best."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.gallery import entries, entry


@nw.model
def tower(n: int = 3):  # type: ignore[no-untyped-def]
    y = 0.0
    for i in range(n):  # noqa: B007
        height = nw.uniform(0.5, 1.5)
        nw.emit(nw.box((0, y + height / 2, 0), (1, height, 1)))
        y = y + height
    nw.query("height", y)
    return y


@pytest.fixture(scope="module")
def grown() -> nw.Result:
    pillar = nw.Target(
        [[x, y, z] for x in (-0.5, 0.5) for y in (0.0, 3.2) for z in (-0.5, 0.5)],
        [
            [0, 1, 3],
            [0, 3, 2],
            [4, 6, 7],
            [4, 7, 5],
            [0, 4, 5],
            [0, 5, 1],
            [2, 3, 7],
            [2, 7, 6],
            [0, 2, 6],
            [0, 6, 4],
            [1, 5, 7],
            [1, 7, 3],
        ],
        name="pillar",
    )
    return nw.grow(tower, pillar, particles=50, voxel=0.2, runs=3, seed=7)


def test_a_grown_result_has_one_sample_for_each_run(grown: nw.Result) -> None:
    assert [sample.seed for sample in grown] == [7, 8, 9]
    assert grown.best.log_score == max(sample.log_score for sample in grown)
    assert grown.best.similarity is not None and grown.best.similarity > 0.9
    assert grown.best.log_joint == grown.best.log_prior + grown.best.log_score
    assert grown.seconds > 0 and grown.best.cpu_seconds > 0
    assert not grown.interrupted


def test_a_sample_has_value_choices_queries_and_scene(grown: nw.Result) -> None:
    best = grown.best
    assert list(best.choices) == ["i[0]/height", "i[1]/height", "i[2]/height"]
    assert best.value == best.queries["height"] == pytest.approx(sum(best.choices.values()))
    assert set(best.families.values()) == {"uniform"}
    assert [part.address for part in best.scene] == ["i[0]/emit", "i[1]/emit", "i[2]/emit"]


def test_reprs_have_the_numbers(grown: nw.Result) -> None:
    assert repr(grown).startswith("<Result of tower: 3 samples, best log score ")
    assert "similarity" in repr(grown.best) and "3 primitives" in repr(grown.best)


def test_files_and_pictures(grown: nw.Result, tmp_path: Path) -> None:
    for suffix in (".glb", ".obj", ".stl", ".ply"):
        assert grown.export(tmp_path / f"tower{suffix}").stat().st_size > 100
    assert grown.save(tmp_path / "tower.png", size=(80, 60), samples=1).read_bytes()[:4] == b"\x89PNG"
    picture = grown.best._repr_png_()
    assert picture is not None and picture[:4] == b"\x89PNG"
    assert grown.sheet(size=(60, 40), samples=1).size[0] >= 120


def test_weights_sum_to_one() -> None:
    weighted = nw.run(tower, method=nw.importance(20), seed=1)
    assert weighted.weights.sum() == pytest.approx(1.0)
    assert np.allclose(weighted.weights, 1 / 20)


def test_arguments_by_position_and_name() -> None:
    assert nw.run(tower, 2, seed=1).best.primitives == 2
    assert nw.run(tower, n=5, seed=1).best.primitives == 5
    assert nw.run(tower, seed=1).best.primitives == 3


def test_choices_can_be_given_and_the_rest_drawn() -> None:
    run = nw.run(tower, choices={"i[1]/height": 1.25}, seed=4).best
    assert run.choices["i[1]/height"] == 1.25
    assert run.choices["i[0]/height"] == nw.run(tower, seed=4).best.choices["i[0]/height"]


def test_values_that_are_no_keys_stand_under_their_repr() -> None:
    @nw.model
    def pair():  # type: ignore[no-untyped-def]
        return [nw.flip(0.25), 1]

    shares = nw.run(pair, method=nw.enumerate_all()).distribution()
    assert shares == pytest.approx({"[True, 1]": 0.25, "[False, 1]": 0.75})


def test_every_model_of_the_gallery_grows() -> None:
    found: list[Any] = entries()
    grown = [one for one in found if one.target_name is not None]
    assert {"spaceship"} <= {one.name for one in grown}
    assert all(one.title for one in found)
    for one in grown:
        target = one.target()
        assert target is not None
        coarse = float(max(target.size)) / 20
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a run of a few particles may become impossible
            result = nw.grow(one.model, target, particles=100, voxel=coarse, seed=1, runs=4)
        assert result.best.primitives > 0
    assert entry("targets") is None and entry("no such") is None
