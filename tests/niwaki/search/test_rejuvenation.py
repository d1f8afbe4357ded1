"""`smc(rejuvenate=...)` from Python: what is reported, what is refused, and scenes that agree with their choices."""

import niwaki
import pytest
from niwaki import kernels
from niwaki.errors import InputError
from niwaki.gallery import named_target
from niwaki.gallery.gnarly_tree import gnarly_tree

SHAPE = ["yaw", "pitch", "length", "end", "angle", "thick"]
KERNEL = kernels.mixture(
    kernels.on(SHAPE, kernels.block(0.003)), kernels.drift(0.3), kernels.prior(), kernels.regenerate(1)
)


@pytest.fixture(scope="module")
def score():
    return niwaki.no_self_intersection() * niwaki.match_volume(
        named_target("bent_tube"), voxel=0.6, sigma=0.05
    )


@pytest.mark.parametrize("at", [7, "resampled", "end"])
def test_moved_particles_agree_with_their_choices(score, at):
    method = niwaki.smc(12, rejuvenate=KERNEL, moves=3, at=at)
    result = niwaki.run(gnarly_tree, method=method, score=score, seed=3, threads=1)
    (running, running_kept), (ended, ended_kept) = result.info.moved_running, result.info.moved_ended
    assert 0 < ended_kept <= ended
    assert (0 < running_kept <= running) == (at != "end")
    for sample in result:
        again = niwaki.run(gnarly_tree, choices=sample.choices, score=score)[0]
        assert again.log_score == sample.log_score
        assert again.log_prior == sample.log_prior
        assert again.primitives == sample.primitives


def test_the_same_seed_gives_the_same_result_on_any_number_of_threads(score):
    method = niwaki.smc(40, rejuvenate=KERNEL, moves=2, at=5)
    single, double = (
        niwaki.run(gnarly_tree, method=method, score=score, seed=5, threads=threads) for threads in (1, 2)
    )
    assert [s.log_score for s in single] == [s.log_score for s in double]
    assert single.info == double.info


def test_moves_make_copies_different(score):
    def unique(**settings):
        method = niwaki.smc(20, power=4.0, **settings)
        return niwaki.run(gnarly_tree, method=method, score=score, seed=2).unique_models

    assert unique() < 5
    assert unique(rejuvenate=kernels.on(SHAPE, kernels.block(0.002)), moves=8, at="end") > 10


def test_final_chains_take_the_place_of_the_final_set(score):
    """Two chains of twenty states: each is what its choices say, and most are no copy of another."""
    kernel = kernels.cycle(kernels.repeat(4, kernels.prior()), kernels.on(SHAPE, kernels.block(0.001)))
    method = niwaki.smc(20, power=4.0, rejuvenate=kernel, moves=5, at="end", draws=20, chains=2)
    result = niwaki.run(gnarly_tree, method=method, score=score, seed=2, threads=1)
    plain = niwaki.run(gnarly_tree, method=niwaki.smc(20, power=4.0), score=score, seed=2, threads=1)
    assert (
        len(result) == 40 and result.info.moved_running == (0, 0) and result.info.moved_ended.proposed == 200
    )
    assert result.unique_models > 20
    assert result.best.log_score >= plain.best.log_score
    for sample in [result[0], result[19], result[-1]]:
        again = niwaki.run(gnarly_tree, choices=sample.choices, score=score)[0]
        assert (again.log_score, again.log_prior) == (sample.log_score, sample.log_prior)
        assert (again.primitives, again.similarity) == (sample.primitives, sample.similarity)


def test_grow_moves_too(score):
    settings = {"score": score, "particles": 20, "power": 4.0, "seed": 2, "threads": 1}
    moves = {"rejuvenate": kernels.prior(), "moves": 30, "at": "end", "draws": 5}
    result = niwaki.grow(gnarly_tree, **settings, **moves)
    assert len(result) == 1
    assert result.best.log_score >= niwaki.grow(gnarly_tree, **settings).best.log_score


@pytest.mark.parametrize(
    ("settings", "name"),
    [
        ({"rejuvenate": "drift"}, "rejuvenate"),
        ({"rejuvenate": kernels.prior(), "moves": 0}, "moves"),
        ({"rejuvenate": kernels.prior(), "at": 0}, "at"),
        ({"rejuvenate": kernels.prior(), "at": "later"}, "at"),
        ({"rejuvenate": kernels.prior(), "weights": "absolute"}, "rejuvenate"),
        ({"rejuvenate": kernels.repeat(2, kernels.anneal(kernels.prior(), 5))}, "rejuvenate"),
        ({"rejuvenate": kernels.tempering(kernels.prior())}, "rejuvenate"),
        ({"rejuvenate": kernels.prior(), "draws": 0}, "draws"),
        ({"draws": 3}, "draws"),
        ({"rejuvenate": kernels.prior(), "chains": 3}, "chains"),
        ({"rejuvenate": kernels.prior(), "draws": 3, "chains": 0}, "chains"),
    ],
)
def test_what_makes_no_sense_is_refused(settings, name):
    with pytest.raises(InputError, match=f"`{name}`"):
        niwaki.smc(10, **settings)


def test_the_originals_chain_runs_on_the_same_model(score):
    kernel = kernels.original(nesting="side_branch")
    result = niwaki.run(gnarly_tree, method=niwaki.mh(3000, kernel=kernel), score=score, seed=1)
    start = niwaki.run(gnarly_tree, method=niwaki.mh(1, kernel=kernel), score=score, seed=1)
    assert result.best.log_score > start.best.log_score
    assert kernels.parse("original(power=4)") == kernels.original(4.0)
