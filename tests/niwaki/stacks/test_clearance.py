"""Claim: a missing gap or thickness costs the known amount; blocks that lack neither cost almost nothing.

Distances to check against are those of boxes, by hand.
"""

from __future__ import annotations

from typing import Any

import niwaki as nw
import pytest
from niwaki import stacks
from niwaki.stacks.blocks import BOTTOM, TOP, box_corners
from niwaki.stacks.clearance import GAP, LEAST, SOFT, apart, neighbours, thick
from niwaki.stacks.contacts import GROUND, Contact, contact, corners


def box(x: float, z: float, wide: float = 0.05, high: float = 0.05) -> Any:
    return box_corners(nw.vec(x, 0.0, z), wide, 0.05, high)


def score_of(first: Any, second: Any) -> float:
    """Return the score of two blocks for their thickness and the gap between them."""

    @nw.model
    def two() -> float:
        apart(first, thick(first), second, thick(second))
        return 0.0

    return nw.run_python(two, seed=1).log_score


def lacking(distance: float, least: float) -> float:
    """Twice the score of a distance that should be `least`, by the words' formula."""
    d = (least - distance) / SOFT
    return -0.5 * ((d + (d * d + 1.0) ** 0.5) / 2.0) ** 2


#: Two boxes of 50 mm, each thick in three directions, between two faces each.
CUBES = 12 * lacking(0.05, LEAST)


@pytest.mark.parametrize("gap", [0.02, GAP, GAP - SOFT, 0.0, -0.01])
def test_a_missing_gap_is_penalised(gap: float) -> None:
    expected = CUBES + lacking(gap, GAP)
    assert score_of(box(0.0, 0.0), box(0.05 + gap, 0.0)) == pytest.approx(expected, abs=1e-6)
    assert score_of(box(0.05 + gap, 0.0), box(0.0, 0.0)) == pytest.approx(expected, abs=1e-6)


def test_distant_blocks_are_hardly_penalised() -> None:
    assert -1e-3 < score_of(box(0.0, 0.0), box(0.2, 0.0)) <= 0.0
    assert score_of(box(0.0, 0.0), box(0.04, 0.0)) < -50.0


def test_a_missing_thickness_is_penalised_at_both_faces() -> None:
    thin = box(0.0, 0.0, high=LEAST - 2.0 * SOFT)
    change = 2 * (lacking(LEAST - 2.0 * SOFT, LEAST) - lacking(0.05, LEAST))
    assert score_of(thin, box(0.2, 0.0)) == pytest.approx(CUBES + change, abs=1e-3)


def test_a_corner_beyond_the_opposite_face_is_penalised() -> None:
    block = list(box(0.0, 0.0))
    block[4] = block[4] + nw.vec(0.0, 0.0, -0.06)
    assert score_of(tuple(block), box(0.3, 0.0)) < -50.0


def touches(pairs: list[tuple[int, int]]) -> list[Contact]:
    zero = nw.vec(0.0, 0.0, 0.0)
    return [Contact(first, second, (zero,) * 4, zero, zero, zero) for first, second in pairs]


def test_neighbours_touch_the_same_third_and_not_each_other() -> None:
    pile = touches([(0, GROUND), (1, 0), (2, 1)])
    assert sorted(neighbours(pile)) == [(1, GROUND), (2, 0)]
    # A triangle: all touch one another.
    assert neighbours(touches([(1, 0), (2, 1), (0, 2)])) == []
    # Two feet of one arch.
    arch = touches([(0, 1), (1, 2), (0, GROUND), (2, GROUND)])
    assert sorted(neighbours(arch)) == [(1, GROUND), (2, 0)]


def test_a_spoke_is_kept_from_the_neighbours_of_what_it_holds() -> None:
    pairs = neighbours(nw.run_python(stacks.wheel, seed=1).value.contacts)
    # The spoke is 26 to 28; its foot is on block 4 of the inner arch, its head under block 17, of the outer one.
    assert {(26, 3), (26, 5), (28, 16), (28, 18)} <= set(pairs)


@nw.model
def beside(width: float = 0.01) -> float:
    lower, upper = box(0.0, 0.0), box(nw.uniform(0.1, 0.2), 0.05)
    touch = contact(0, corners(lower, TOP), 1, corners(upper, BOTTOM))
    nw.factor(nw.softeq(touch.points[0].x, 0.0, width))
    return 0.0


def test_a_vanished_contact_is_reported_with_its_place() -> None:
    with pytest.raises(nw.NiwakiError) as error:
        stacks.start(beside, seed=1, width=0.01)
    assert error.value.code == "impossible-trace"
    message = error.value.render()
    assert "contacts.py" in message and "condition(low_x < high_x and low_y < high_y)" in message
    assert "beside at" in message
