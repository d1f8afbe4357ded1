"""Thin targets: boards, posts and gaps that the usual cells are too coarse for.

A solid fills all cells that it touches. So cells of a size h make a board of thickness t about t + h thick, and its
volume in cells says how thin it is beside them. Cells of half the size fill

    (t + h) / (t + h / 2)

times less: 1.2 times for a board of two cells, and less than that for thicker parts. A thin gap counts, too, because
coarse cells close it.

A mesh with holes is another case. Where only the smaller cells leave a hole open, the outside comes in, and hollow
parts lose their inside. Such a mesh keeps the usual cells.
"""

from __future__ import annotations

from math import prod

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.targets.target import Target

#: A target is thin if the usual cells fill so much more than those of half the size: parts are thinner than two cells.
THIN = 1.2
#: Most cells of the finer grid: eight times the usual number, and what the margin around a target adds.
FINEST = 1_000_000
#: The share of a target's cells that may be lost inside of it before its mesh counts as hollow.
HOLLOW = 0.02


def is_thin(target: Target, voxel: float) -> bool:
    """Return whether cells of half the size follow a target much better, and are few enough."""
    try:
        coarse = _engine.Target(target.vertices, target.faces, voxel)
        if 8 * prod(coarse.dims) > FINEST:
            return False
        fine = _engine.Target(target.vertices, target.faces, 0.5 * voxel)
    except ValueError:
        # The sketch itself says what is wrong with the size.
        return False
    if _volume(coarse) < THIN * _volume(fine):
        return False
    return target.open_edges == 0 or not _is_hollow(coarse.cells(), fine.cells())


def _volume(grid: _engine.Target) -> float:
    """Return the volume of the filled cells, cubic scene units."""
    low, high = grid.domain
    return grid.filled * prod(b - a for a, b in zip(low, high, strict=True)) / prod(grid.dims)


def _is_hollow(coarse: NDArray[np.bool_], fine: NDArray[np.bool_]) -> bool:
    """Return whether the finer cells lose much that is not near any of them: the inside, through a hole of the mesh."""
    near = fine.copy()
    for _ in range(2):
        for axis in range(3):
            rows = np.moveaxis(near, axis, 0)
            before = rows.copy()
            rows[1:] |= before[:-1]
            rows[:-1] |= before[1:]
    # The finer cell at the middle of each coarse one.
    at = [((np.arange(n) + 0.5) * (m / n)).astype(int) for n, m in zip(coarse.shape, fine.shape, strict=True)]
    lost = int((coarse & ~near[np.ix_(*at)]).sum())
    return lost > HOLLOW * int(coarse.sum())
