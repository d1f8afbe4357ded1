"""Drawings for the tests of guides: bars that lead to one side."""

from __future__ import annotations

from typing import Any

import numpy as np


def page(side: int) -> np.ndarray[Any, Any]:
    """A slanted bar that leads to one side."""
    greys = np.full((24, 24), 255, dtype=np.uint8)
    for row in range(2, 22):
        middle = 12 + side * (row - 12) // 3
        greys[row, middle - 3 : middle + 3] = 0
    return greys


PAGES = [page(side) for side in (-3, -2, -1, 1, 2, 3)]
