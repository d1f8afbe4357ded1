"""Claim: thin boards and posts are found by their cells, and `grow` scores such targets by smaller, balanced cells."""

from __future__ import annotations

import niwaki as nw
import numpy as np
import pytest
from niwaki import box
from niwaki.search.entry import grow_search
from niwaki.targets import asks
from niwaki.targets.sketches import automatic_voxel, volume_score
from niwaki.targets.thin import FINEST, is_thin

BLOCK = nw.Target.of_shapes(box((0, 2, 0), (4, 4, 4)))


def table(thickness: float) -> nw.Target:
    """A table top on four legs of the same thickness."""
    legs = [box((x, 2, z), (thickness, 4, thickness)) for x in (-2.4, 2.4) for z in (-1.4, 1.4)]
    return nw.Target.of_shapes(box((0, 4, 0), (5, thickness, 3)), *legs)


def hollow_box(hole: float) -> nw.Target:
    """A box of ten units, of sheets without thickness, with a square hole in the top around a smaller cell."""
    low, high, a, b = -5.0, 5.0, 0.06 - 0.5 * hole, 0.06 + 0.5 * hole
    corners = [
        (x, y, z) for y in (low, high) for x, z in ((low, low), (high, low), (high, high), (low, high))
    ]
    corners += [(x, high, z) for x, z in ((a, a), (b, a), (b, b), (a, b))]
    quads = [(0, 1, 2, 3), *((k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4))]
    quads += [(4 + k, 4 + (k + 1) % 4, 8 + (k + 1) % 4, 8 + k) for k in range(4)]
    faces = [face for i, j, k, m in quads for face in ((i, j, k), (i, k, m))]
    return nw.Target(corners, faces)


def is_thin_for_grow(target: nw.Target) -> bool:
    return is_thin(target, automatic_voxel(target))


def test_boards_and_posts_of_less_than_two_cells_are_thin() -> None:
    thin, thick = table(0.08), table(1.2)
    size = automatic_voxel(thin)
    assert 0.08 < size and 1.2 > 8 * automatic_voxel(thick)
    assert is_thin_for_grow(thin) and not is_thin_for_grow(thick)
    # The same target is not thin beside smaller cells.
    assert not is_thin(thin, 0.3 * size)
    assert not is_thin_for_grow(BLOCK)


@pytest.mark.filterwarnings("ignore::niwaki.targets.target.TargetWarning")
def test_a_hole_that_only_smaller_cells_leave_open_does_not_count() -> None:
    """Half the cells would see an empty box: the usual cells fill it, and go on doing so."""
    target = hollow_box(0.24)
    size = automatic_voxel(target)
    assert target.open_edges == 4 and 0.12 < size < 0.3
    coarse, fine = (nw.match_volume(target, size * k).asks[0].grid for k in (1.0, 0.5))
    assert coarse is not None and fine is not None
    assert np.mean(coarse.cells()) > 0.8 and np.mean(fine.cells()) < 0.3
    assert not is_thin(target, size)


def test_a_grid_that_would_be_too_large_is_left() -> None:
    target = table(0.1)
    size = (np.prod(target.size + 0.2) / FINEST) ** (1 / 3)
    assert is_thin(target, float(2.1 * size)) and not is_thin(target, float(1.9 * size))
    assert not is_thin(target, 1e-6)


@nw.model
def plank() -> None:
    nw.emit(box((0, 4, 0), (nw.uniform(1, 6), 0.1, 3)))


def test_grow_scores_a_thin_target_by_small_balanced_cells() -> None:
    """A size or a weight of the user decides; other targets, other methods of scoring and files stay as they are."""
    target = table(0.1)
    size = automatic_voxel(target)

    def cells_of(score: nw.Score) -> tuple[float, str]:
        call = next(ask for ask in score.asks if ask.function == "match_volume")
        return call.arguments["voxel"], call.arguments.get("weight", "cells")

    assert cells_of(grow_search(plank, target, seed=1).score) == (0.5 * size, "balanced")
    assert cells_of(grow_search(plank, target, seed=1, voxel=size).score) == (size, "cells")
    assert cells_of(grow_search(plank, target, seed=1, weight="cells").score) == (size, "cells")
    assert cells_of(grow_search(plank, target, seed=1, weight="balanced").score) == (size, "balanced")
    assert cells_of(grow_search(plank, BLOCK, seed=1).score) == (automatic_voxel(BLOCK), "cells")
    assert cells_of(nw.match_volume(target)) == (size, "cells")
    terms = asks.sketches_of({"target": target})
    assert cells_of(asks.score(terms, volume_score)) == (0.5 * size, "balanced")
    assert cells_of(asks.score(terms)) == (size, "cells")
    terms = asks.sketches_of({"target": target, "volume_weight": "balanced", "voxel": 0.3})
    assert cells_of(asks.score(terms, volume_score)) == (0.3, "balanced")
