"""Solids with holes in searches: the same bits by every strategy and number of threads, and what gradients see."""

import niwaki as nw
import pytest
from niwaki import Target
from niwaki.errors import InputError
from niwaki.words import Gaussian

#: What the walls fill: a block with an opening.
TARGET = Target.of_shapes(
    nw.box((-0.9, 0.0, 0.0), (1.0, 2.0, 0.6)),
    nw.box((0.9, 0.0, 0.0), (1.0, 2.0, 0.6)),
    nw.box((0.0, 0.7, 0.0), (0.8, 0.6, 0.6)),
)


@nw.model
def wall():
    x = nw.uniform(-1.0, 1.0)
    low = nw.gaussian(-0.3, 0.2)
    solid = nw.box((0.0, 0.0, 0.0), (2.8, 2.0, 0.6))
    opening = nw.box((x, low, 0.0), (0.8, 1.4, 1.0)) | nw.cylinder((x, low + 0.7, 0.0), 0.4, 1.0, axis="z")
    nw.emit(solid - opening, name="wall")
    if nw.flip(0.5):
        # A part in the opening, which may not touch the wall.
        nw.emit(opening & nw.box((nw.uniform(-1.0, 1.0), low, 0.0), (0.3, 0.3, 0.1)), name="pane")
    nw.observe(Gaussian(low, 0.3), -0.2)


def score():
    return nw.no_self_intersection() * nw.match_volume(TARGET, 0.25)


def bits(result):
    return [(sample.choices, sample.log_score, sample.log_weight) for sample in result.samples]


@pytest.mark.parametrize(
    "settings", [{"particles": 7, "power": 0.01}, {"particles": 40, "populations": 2}], ids=["few", "many"]
)
def test_particles_have_the_same_bits_on_every_number_of_threads(settings):
    first, *results = (
        nw.run(wall, nw.smc(**settings), score=score(), seed=4, threads=threads) for threads in (1, 2, 3)
    )
    assert len({sample.choices["x"] for sample in first.samples}) > 1
    for other in results:
        assert bits(other) == bits(first)
    # A run with these choices has the score of the particle: scenes that grow are scored as whole ones.
    for sample in first.samples[:3]:
        assert nw.run(wall, score=score(), choices=sample.choices).best.log_score == sample.log_score


def test_all_strategies_of_a_chain_agree():
    chains = [
        nw.run(wall, nw.mh(150, strategy, keep=10), score=score(), seed=2)
        for strategy in ("c3", "rerun", "resume", "cache")
    ]
    assert len({sample.choices["x"] for sample in chains[0].samples}) > 3
    for other in chains[1:]:
        assert bits(other) == bits(chains[0])


def test_gradients_take_the_scores_of_the_program_and_refuse_those_of_the_scene():
    @nw.model
    def pierced():
        x = nw.gaussian(0.0, 0.5)
        low = nw.gaussian(-0.3, 0.2)
        solid = nw.box((0.0, 0.0, 0.0), (2.8, 2.0, 0.6)) - nw.box((x, low, 0.0), (0.8, 1.4, 1.0))
        nw.emit(solid & nw.box((0.0, 0.0, 0.0), (2.4, 3.0, 1.0)), name="wall")
        nw.observe(Gaussian(low - x, 0.3), -0.2)

    density = nw.run(pierced, nw.forward(), seed=1).best.log_density()
    value, gradient = density.value_and_gradient(density.start)
    step = 1e-5
    for k, slope in enumerate(gradient):
        up, down = list(density.start), list(density.start)
        up[k], down[k] = up[k] + step, down[k] - step
        numeric = (density.value_and_gradient(up)[0] - density.value_and_gradient(down)[0]) / (2 * step)
        assert slope == pytest.approx(numeric, abs=1e-4), k
    assert value == density.value_and_gradient(density.start)[0]
    result = nw.run(pierced, nw.nuts(20, 4, warmup=100), seed=1)
    assert len({sample.choices["x"] for sample in result.samples}) > 3
    with pytest.raises(InputError) as caught:
        nw.run(pierced, nw.nuts(4, 3, warmup=4), score=score(), seed=1)
    assert caught.value.code == "sketch-without-slope"


def test_a_hole_follows_a_drag():
    @nw.model
    def pierced():
        x = nw.uniform(-1.0, 1.0)
        nw.emit(
            nw.box((0.0, 0.0, 0.0), (4.0, 2.0, 0.6)) - nw.box((x, 0.0, 0.0), (0.5, 0.5, 1.0)), name="wall"
        )

    sample = nw.run(pierced, choices={"x": 0.0}).best
    drag = sample.drag("wall", (0.5, 0.0, 0.0), grab=(0.0, 0.0, 0.0))
    assert drag.answers[0].sample.choices["x"] == pytest.approx(0.5, abs=1e-3)
