"""How different results look, and which of many to show: the slider between the best and the most different.

The look of a scene is the set of cells of a coarse grid that its surface touches; two scenes differ by the share of
these cells that only one of them touches (Jaccard 1912). Scenes that are compared share the grid around all of them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from niwaki.result import Sample

#: Cells along the longest side.
CELLS = 24
#: Searches for each result that is shown, to choose from, and the most in all.
MORE, MOST = 3, 48


def candidates(count: int, strength: float) -> int:
    """How many results to choose from."""
    return count if strength == 0.0 else min(MORE * count, max(MOST, count))


def spread(samples: Sequence[Sample], count: int, strength: float) -> list[Sample]:
    """The best, and those that are good or far from all that were taken, as the strength weighs it, in that order."""
    ranked = sorted(samples, key=lambda one: -one.log_score)
    if strength == 0.0 or len(ranked) <= count:
        return ranked[:count]
    return [ranked[place] for place in chosen(distances(ranked), count, strength)]


def ordered(first: Sample, samples: Sequence[Sample], count: int, strength: float) -> list[Sample]:
    """A window of those in the order of their distance from the first: 0 the nearest, 1 the farthest."""
    away = distances([first, *samples])[0, 1:]
    order = np.argsort(away, kind="stable")
    start = round(strength * max(0, len(order) - count))
    return [samples[place] for place in order[start : start + count]]


def chosen(away: NDArray[np.float64], count: int, strength: float) -> list[int]:
    """Places in a ranking by quality, by a greedy choice between quality and distance."""
    places = len(away)
    quality = 1.0 - np.arange(places) / places
    taken = [0]
    while len(taken) < min(count, places):
        value = (1.0 - strength) * quality + strength * away[taken].min(axis=0)
        value[taken] = -np.inf
        taken.append(int(np.argmax(value)))
    return taken


def distances(samples: Sequence[Sample]) -> NDArray[np.float64]:
    """How different each two look, 0 to 1."""
    clouds = [_points(one) for one in samples]
    low = np.min([cloud.min(axis=0) for cloud in clouds if len(cloud)] or [np.zeros(3)], axis=0)
    high = np.max([cloud.max(axis=0) for cloud in clouds if len(cloud)] or [np.ones(3)], axis=0)
    cell = max(float((high - low).max()), 1e-9) / CELLS
    looks = np.zeros((len(clouds), (CELLS + 1) ** 3), dtype=np.float32)
    for look, cloud in zip(looks, clouds, strict=True):
        x, y, z = np.floor((cloud - low) / cell).astype(np.int64).T
        look[(x * (CELLS + 1) + y) * (CELLS + 1) + z] = 1.0
    both, sizes = looks @ looks.T, looks.sum(axis=1)
    union = np.maximum(sizes[:, None] + sizes[None, :] - both, 1.0)
    found: NDArray[np.float64] = 1.0 - (both / union).astype(np.float64)
    return np.where(union > 1.0, found, 0.0)


def _points(one: Sample) -> NDArray[np.float64]:
    """Points of the surfaces: each triangle by a small lattice."""
    steps = np.array([(i, j, 6 - i - j) for i in range(7) for j in range(7 - i)]) / 6.0
    vertices, faces = one.scene.merged(fine=False)
    points: NDArray[np.float64] = np.einsum("sk,tkc->tsc", steps, vertices[faces]).reshape(-1, 3)
    return points
