"""The claim: in a model that does not say where it looks from, a guide looks from the last part, and that pays."""

from __future__ import annotations

import niwaki as nw
import numpy as np
import pytest
from niwaki import box, discrete_uniform, emit, flip, future, model
from niwaki.guides import Training, train_guide
from niwaki.methods import Guide, Method
from niwaki.targets.examples.lofts import block, solid

STEPS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@model
def snake():
    """A path of cubes; where each goes on is not told by anything in scope."""
    emit(box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))
    future(rest, 0.0, 0.0, 0.0)


@model
def rest(x, y, z):
    """The cubes behind one at (x, y, z)."""
    if flip(0.8):
        way = discrete_uniform(0, 2)
        dx, dy, dz = STEPS[way]
        emit(box((x + dx, y + dy, z + dz), (1.0, 1.0, 1.0)))
        future(rest, x + dx, y + dy, z + dz)


def path(seed: int) -> nw.Score:
    """The score of a path of eight cubes."""
    steps = np.array(STEPS)[np.random.default_rng(seed).integers(3, size=7)]
    middles = np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
    cubes = [block(middle - 0.5, middle + 0.5) for middle in middles]
    return nw.match_volume(solid(f"path {seed}", cubes), voxel=0.5)


@pytest.fixture(scope="module")
def guide() -> Guide:
    """A guide for the snake, trained in about a second."""
    return train_guide(
        snake,
        [path(seed) for seed in range(24)],
        lambda score: score,
        held_out=[path(100)],
        rounds=(100,),
        searches=(nw.smc(60),),
        training=Training(hidden=(16, 16), steps=600),
        seed=1,
    )


def test_a_guide_that_looks_from_the_last_part_gains_much(guide: Guide) -> None:
    def mean(method: Method) -> float:
        scores = [path(seed) for seed in range(200, 210)]
        return float(
            np.mean([nw.run(snake, score=score, method=method, seed=1).best.log_score for score in scores])
        )

    assert mean(nw.smc(2, guide=guide)) > mean(nw.smc(6)) + 20.0


def test_it_sees_the_box_of_the_last_part(guide: Guide) -> None:
    assert guide.form["part"] is not None
    assert "the middle of the last part" in guide.show()


@pytest.mark.parametrize("order", ["stochastic", "depth-first"])
def test_threads_do_not_matter(guide: Guide, order: str) -> None:
    method = nw.smc(64, order=order, guide=guide)
    first, second = (nw.run(snake, score=path(7), method=method, seed=3, threads=n) for n in (1, 2))
    assert first.info.log_evidence == second.info.log_evidence
    assert [s.choices for s in first] == [s.choices for s in second]
