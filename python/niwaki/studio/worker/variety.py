"""Variety of results: how different they look, and which to show between the best and the most different.

The look of a scene is the set of cells of a coarse grid that its surface touches. Two scenes differ by the share of
these cells that only one scene touches (Jaccard 1912). Compared scenes share a grid around all of them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from niwaki.result import Sample

#: Cells along the longest side.
CELLS = 24
#: Searches for each result that is shown, and the most searches in all.
MORE, MOST = 3, 48


def candidates(count: int, strength: float) -> int:
    """Return the number of results to choose from."""
    return count if strength == 0.0 else min(MORE * count, max(MOST, count))


def spread(samples: Sequence[Sample], count: int, strength: float) -> list[Sample]:
    """Select the best result, then results that are good or far from all selected results; `strength` weighs both."""
    ranked = sorted(samples, key=lambda sample: -sample.log_score)
    if strength == 0.0 or len(ranked) <= count:
        return ranked[:count]
    return [ranked[place] for place in chosen(distances(ranked), count, strength)]


def ordered(first: Sample, samples: Sequence[Sample], count: int, strength: float) -> list[Sample]:
    """Select neighbours in the order of their distance from the first: strength 0 the nearest, 1 the farthest."""
    away = distances([first, *samples])[0, 1:]
    order = np.argsort(away, kind="stable")
    start = round(strength * max(0, len(order) - count))
    return [samples[place] for place in order[start : start + count]]


def chosen(away: NDArray[np.float64], count: int, strength: float) -> list[int]:
    """Choose places in a ranking by quality: a greedy choice between quality and distance."""
    places = len(away)
    quality = 1.0 - np.arange(places) / places
    selected = [0]
    while len(selected) < min(count, places):
        value = (1.0 - strength) * quality + strength * away[selected].min(axis=0)
        value[selected] = -np.inf
        selected.append(int(np.argmax(value)))
    return selected


def distances(samples: Sequence[Sample]) -> NDArray[np.float64]:
    """Compute how different each two samples look, 0 to 1."""
    clouds = [_points(sample) for sample in samples]
    low = np.min([cloud.min(axis=0) for cloud in clouds if len(cloud)] or [np.zeros(3)], axis=0)
    high = np.max([cloud.max(axis=0) for cloud in clouds if len(cloud)] or [np.ones(3)], axis=0)
    cell = max(float((high - low).max()), 1e-9) / CELLS
    looks = np.zeros((len(clouds), (CELLS + 1) ** 3), dtype=np.float32)
    for look, cloud in zip(looks, clouds, strict=True):
        x, y, z = np.floor((cloud - low) / cell).astype(np.int64).T
        look[(x * (CELLS + 1) + y) * (CELLS + 1) + z] = 1.0
    both, sizes = looks @ looks.T, looks.sum(axis=1)
    union = np.maximum(sizes[:, None] + sizes[None, :] - both, 1.0)
    different: NDArray[np.float64] = 1.0 - (both / union).astype(np.float64)
    return np.where(union > 1.0, different, 0.0)


def _points(sample: Sample) -> NDArray[np.float64]:
    """Cover each triangle of the surfaces with a small lattice of points."""
    steps = np.array([(i, j, 6 - i - j) for i in range(7) for j in range(7 - i)]) / 6.0
    vertices, faces = sample.scene.merged(fine=False)
    points: NDArray[np.float64] = np.einsum("sk,tkc->tsc", steps, vertices[faces]).reshape(-1, 3)
    return points
