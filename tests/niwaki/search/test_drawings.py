"""Claim: populations and chains draw in the plane as they build in space: exact, and the same bits by each strategy.

The evidence of a small program is compared with its enumeration. Under the null the mean of the estimates is off by
more than 4 standard errors in 6e-5 of the cases, for each of the two scores.
"""

from __future__ import annotations

import math
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import _engine, kernels
from niwaki.gallery.vines import vines
from niwaki.words import choose, disc, emit, flip, stroke

WINDOW = ((-2.0, -1.0), (2.0, 3.0))
PAGE = np.full((24, 24), 255, dtype=np.uint8)
PAGE[4:20, 10:15] = 0

SCORES = {
    "match_drawing": lambda: nw.match_drawing(PAGE, WINDOW, sigma=0.3),
    "fill_drawing": lambda: nw.fill_drawing(WINDOW, (24, 24), 0.3, sigma=0.1),
}


@nw.model
def path():  # type: ignore[no-untyped-def]
    """A stroke or two, each to one of three sides, and perhaps a disc at the end."""
    step(0.0, -0.6, 0)


@nw.model
def step(x, y, depth):  # type: ignore[no-untyped-def]
    """One stroke, and perhaps another."""
    aside = choose([-0.9, 0.0, 0.9])
    emit(stroke((x, y, 0.0), (x + aside, y + 1.2, 0.0), 0.7, 0.4))
    if depth < 1 and flip(0.6):
        step(x + aside, y + 1.2, depth + 1)
    elif flip(0.5):
        emit(disc((x + aside, y + 1.2, 1.0), 0.5))


@pytest.mark.parametrize("name", SCORES)
def test_the_evidence_is_that_of_enumeration(name: str) -> None:
    score = SCORES[name]()
    exact = nw.run(path, nw.enumerate_all(), score=score, seed=1).log_evidence
    runs = [nw.run(path, nw.smc(8), score=score, seed=seed).log_evidence for seed in range(400)]
    ratios = np.exp(np.array(runs) - exact)
    error = ratios.std(ddof=1) / math.sqrt(len(ratios))
    assert 0.0 < error < 0.1
    assert abs(ratios.mean() - 1.0) < 4.0 * error


@pytest.mark.parametrize("name", SCORES)
def test_chains_are_the_same_by_each_strategy_and_as_scored_afresh(name: str) -> None:
    score = SCORES[name]()
    method = {"steps": 600, "keep": 6, "chains": 2, "kernel": kernels.cycle(kernels.prior(), kernels.drift())}
    states: dict[str, Any] = {}
    for strategy in ("c3", "resume", "cache", "rerun"):
        chain = nw.run(vines, nw.mh(**method, strategy=strategy), score=score, seed=3)
        states[strategy] = [(state.log_score, state.similarity, state.choices) for state in chain]
        for sample in chain:
            sketch = _engine.Sketch(score.specs)
            for part in sample.scene:
                sketch.add(list(part.shapes))
            assert sketch.log_score() == sample.log_score
    assert all(values == states["c3"] for values in states.values())
    assert len({score for score, _, _ in states["c3"]}) > 3


def test_a_drawing_is_followed_and_no_intersection_is_asked_of_it() -> None:
    result = nw.grow(vines, None, 0.0, -0.6, score=SCORES["match_drawing"](), particles=40, seed=1)
    assert [sketch.function for sketch in result.search.score.asks] == ["match_drawing"]
    assert result.best.similarity is not None and result.best.similarity > 0.2
    again = nw.Search.of_data(result.search.data()).run()
    assert again.best.log_score == result.best.log_score
