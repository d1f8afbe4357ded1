"""Guides of the dissertation's architecture: exact weights, files, and what is refused.

The program is finite, so its evidence is known by enumeration. The z test fails by chance once in 1.7 million runs (5
deviations).
"""

import niwaki as nw
import numpy as np
import pytest
from niwaki.guides import Training, train_guide
from niwaki.methods import Guide
from niwaki.targets.drawing import Drawing

WINDOW = ((0.0, 0.0), (10.0, 10.0))


@nw.model
def dots(x, y):
    """Up to three discs in a column, of three sizes."""
    for k in range(3):
        nw.look((x, y + 3.0 * k), (0.0, 1.0))
        size = nw.choose([0.6, 1.1, 1.6])
        if nw.flip(0.5):
            nw.emit(nw.disc((x, y + 3.0 * k, 0.0), size))


def drawing(seed):
    """Some of the discs of the program."""
    rows, columns = np.mgrid[0:30, 0:30]
    greys = np.full((30, 30), 255, dtype=np.uint8)
    for k, radius in enumerate(np.random.default_rng(seed).choice([0.0, 0.6, 1.1, 1.6], 3)):
        far = (columns / 3 - 5.0) ** 2 + ((29 - rows) / 3 - 2.0 - 3.0 * k) ** 2
        greys[far < radius**2] = 0
    greys[15, 15] = 0
    return Drawing(str(seed), greys, (0.5, 0.2))


def score(page):
    """Wide enough that all runs count."""
    return page.score(WINDOW, sigma=0.5)


@pytest.fixture(scope="module")
def guide():
    training = Training.dissertation(steps=300, share=0.1, reads=("k",))
    every = [drawing(seed) for seed in range(8)]
    return train_guide(
        dots,
        every,
        score,
        lambda page: page.place(WINDOW)[:2],
        rounds=(30,),
        searches=(nw.smc(20),),
        training=training,
        seed=4,
    )


def estimates(page, method, seeds):
    args = page.place(WINDOW)[:2]
    runs = (
        nw.run(dots, *args, score=score(page), method=method, seed=seed, threads=1) for seed in range(seeds)
    )
    return np.exp([run.log_evidence for run in runs])


@pytest.mark.parametrize(
    ("particles", "resampling", "seeds"), [(1, "systematic", 1500), (5, "tempered", 500)]
)
def test_evidence_is_that_of_enumeration(guide, particles, resampling, seeds):
    page = drawing(3)
    args = page.place(WINDOW)[:2]
    exact = np.exp(nw.run(dots, *args, score=score(page), method=nw.enumerate_all()).log_evidence)
    values = estimates(page, nw.smc(particles, resampling=resampling, guide=guide), seeds)
    assert abs(values.mean() - exact) < 5.0 * values.std() / np.sqrt(seeds)
    # The guide is no prior: without its weights the estimate would be another.
    plain = estimates(page, nw.smc(particles, resampling=resampling), 100)
    assert not np.isclose(plain.std(), values.std(), rtol=0.02)


def test_its_file_comes_back(guide, tmp_path):
    guide.save(tmp_path / "dots.guide")
    back = Guide.load(tmp_path / "dots.guide")
    assert back == guide
    assert "the page of match_drawing: windows of 3 by 3 in four resolutions" in back.show()
    again = [estimates(drawing(2), nw.smc(4, guide=loaded), 3).tolist() for loaded in (guide, back)]
    assert again[0] == again[1]


def test_a_score_without_a_page_is_refused(guide):
    with pytest.raises(nw.InputError, match="looks at `match_drawing`"):
        nw.run(dots, 0.0, 0.0, method=nw.smc(4, guide=guide), seed=1)


@pytest.mark.parametrize(
    "settings", [{"architecture": "large"}, {"looks": "target"}, {"share": 0.0}, {"share": 1.0}]
)
def test_settings_that_cannot_be_are_refused(settings):
    with pytest.raises(nw.InputError):
        Training(**settings)
