"""Boxes as arrays of their lowest and their highest corners, (..., 2, 3), and what two of them share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Two parts touch, or overlap, within this share of the scene's size.
TOUCHING = 1e-3
#: A length is as large as another within this share of the scene's size: differences of coordinates round.
EXACT = 1e-9


def overlaps(first: Array, second: Array, least: float = 0.0) -> Array:
    """Return the side of a cube as large as what two boxes share.

    Parameters
    ----------
    first, second
        The boxes.
    least
        Boxes that share less along an axis only touch.
    """
    sides = np.minimum(first[..., 1, :], second[..., 1, :]) - np.maximum(first[..., 0, :], second[..., 0, :])
    return np.asarray(np.cbrt(np.prod(np.where(sides > least, sides, 0.0), axis=-1)))


def depths(first: Array, second: Array) -> Array:
    """Return how deep two boxes overlap: the shortest side of what they share, below 0 if they are apart."""
    sides = np.minimum(first[..., 1, :], second[..., 1, :]) - np.maximum(first[..., 0, :], second[..., 0, :])
    return np.asarray(sides.min(axis=-1))
