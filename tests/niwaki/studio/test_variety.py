"""Variety: the choice of results between the best and the most different."""

from __future__ import annotations

from itertools import combinations

import niwaki as nw
import numpy as np
import pytest
from niwaki.errors import InputError
from niwaki.studio.worker import jobs, variety


@nw.model
def brick():
    """A brick somewhere on a line."""
    nw.emit(nw.box((nw.uniform(-9.0, 9.0), 0.0, 0.0), (1.0, 1.0, 1.0)))


def bricks(*places):
    return [nw.run(brick, choices={"uniform": place}).best for place in places]


def test_the_same_look_has_distance_zero_and_separate_bricks_distance_one():
    away = variety.distances(bricks(0.0, 0.0, 5.0, 5.2))
    assert away[0, 1] == 0.0 and away[0, 2] == 1.0 and 0.0 < away[2, 3] < 1.0
    assert np.array_equal(away, away.T)


@pytest.mark.parametrize("seed", range(5))
def test_the_strongest_choice_takes_the_farthest_each_time_and_the_weakest_the_best(seed):
    away = np.random.default_rng(seed).uniform(size=(9, 9))
    away = np.triu(away, 1) + np.triu(away, 1).T
    assert variety.chosen(away, 4, 0.0) == [0, 1, 2, 3]
    selected = variety.chosen(away, 4, 1.0)
    for k in range(1, 4):
        rest = [j for j in range(9) if j not in selected[:k]]
        assert selected[k] == max(rest, key=lambda j: min(away[j, i] for i in selected[:k]))


@nw.model
def shifted():
    """A place on a line."""
    return nw.uniform(0.0, 1.0)


@nw.model
def hook():
    """A box whose place is within a thousandth of a half, which is known after its call."""
    place = shifted()
    nw.condition(abs(place - 0.5) < 0.001)
    nw.emit(nw.box((place, 0.0, 0.0), (1.0, 1.0, 1.0)))


def test_a_part_that_fits_no_particle_moves_by_small_steps():
    whole = nw.run(hook, choices={"shifted/uniform": 0.5}).best
    with pytest.raises(InputError) as caught:
        whole.regrow("shifted", jobs.REGROWTH_PARTICLES, seed=4)
    assert caught.value.code == "everything-impossible"
    form = jobs.form_of_part(whole, "shifted", 4)
    assert 0.0 < abs(form.choices["shifted/uniform"] - 0.5) < 0.001


def test_variants_come_in_the_order_of_their_distance():
    first, *variants = bricks(0.0, 5.0, 0.3, 0.0, 0.6)
    near = variety.ordered(first, variants, 2, 0.0)
    far = variety.ordered(first, variants, 2, 1.0)
    assert [variant.choices["uniform"] for variant in near] == [0.0, 0.3]
    assert [variant.choices["uniform"] for variant in far] == [0.6, 5.0]


def test_a_gallery_with_strength_differs_more():
    ship = nw.Target.find("gallery:ship")
    from niwaki.gallery.spaceship import spaceship

    result = nw.grow(spaceship, ship, seed=2, diverse=variety.candidates(4, 1.0), rounds=2)
    plain, strong = (variety.spread(result.samples, 4, strength) for strength in (0.0, 1.0))
    assert plain[0] is strong[0] is result.best

    def least(samples):
        away = variety.distances(samples)
        return min(away[i, j] for i, j in combinations(range(4), 2))

    assert least(strong) >= least(plain)
