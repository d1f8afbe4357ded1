"""Places for several results: a square grid on the ground, the best first."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, sqrt

#: The distance between results, as a factor of the longest side.
APART = 1.25


def places(sizes: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Compute the places of results, (x, y) of Blender: rows along x, the next row behind.

    Parameters
    ----------
    sizes
        The extent of each result along x and y.
    """
    columns = ceil(sqrt(len(sizes)))
    wide = APART * max((x for x, _ in sizes), default=0.0)
    deep = APART * max((y for _, y in sizes), default=0.0)
    return [(wide * (number % columns), deep * (number // columns)) for number in range(len(sizes))]
