"""Drawings to grow into: ink on paper, with the point and the direction from which a model starts."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import targets
from niwaki.targets.sketches import Score, Window, check_window, match_drawing

if TYPE_CHECKING:
    from niwaki.targets.images import Image

Point = tuple[float, float]

#: The distance of a start from the edge of the ink, as a share of the image's longer side.
DEEP = 0.035


@dataclass(frozen=True, eq=False)
class Drawing:
    """A drawing with the start of a model.

    Attributes
    ----------
    name : str
        Its name in captions and messages.
    greys : (rows, columns) uint8
        255 where there is no ink.
    start : (x, y)
        As shares of the image, from its lower left corner.
    ahead : (x, y)
        The direction, x to the right and y upwards.
    """

    name: str
    greys: NDArray[np.uint8]
    start: Point
    ahead: Point = (0.0, 1.0)

    @classmethod
    def load(cls, image: Image, pixels: int | None = 50) -> Drawing:
        """Read a drawing from a file, a Pillow image or an array. It starts at the lowest point well inside of the ink.

        Parameters
        ----------
        image
            Dark ink on white or transparent paper.
        pixels
            Pixels of the longer side: a larger image is made smaller. None keeps its size.
        """
        greys = targets.images.ink(image, pixels)
        return cls(targets.images.name_of(image), greys, lowest(greys < 255))

    def window(self, window: Window) -> Window:
        """Return the part of the plane that the drawing fills: `window`, wider or higher so that pixels are square.

        The window grows to both sides, and upwards.
        """
        (left, low), (right, high) = check_window(window)
        rows, columns = self.greys.shape
        wide, tall = right - left, high - low
        if columns * tall > rows * wide:
            more = 0.5 * (tall * columns / rows - wide)
            return (left - more, low), (right + more, high)
        return (left, low), (right, low + wide * rows / columns)

    def place(self, window: Window) -> tuple[float, float, Point]:
        """Return the start in the plane and the direction: the arguments of a model that follows a drawing."""
        (left, low), (right, high) = self.window(window)
        x, y = self.start
        return left + x * (right - left), low + y * (high - low), self.ahead

    def score(self, window: Window, **settings: Any) -> Score:
        """Score scenes by how well they draw it; `settings` are arguments of `match_drawing`."""
        return match_drawing(self.greys, self.window(window), **settings)

    def mirrored(self) -> Drawing:
        """Return the drawing with left and right exchanged."""
        (x, y), (u, v) = self.start, self.ahead
        greys = np.ascontiguousarray(self.greys[:, ::-1])
        return replace(self, name=f"{self.name}, mirrored", greys=greys, start=(1.0 - x, y), ahead=(-u, v))


def lowest(filled: NDArray[np.bool_], deep: float = DEEP) -> Point:
    """Find the lowest pixel with ink all around it, as shares of the image from its lower left corner.

    Parameters
    ----------
    filled
        (rows, columns): where there is ink.
    deep
        Radius of the ink around it, as a share of the longer side; smaller where no ink is that thick.
    """
    rows, columns = filled.shape
    inside, radius = filled, deep * max(rows, columns)
    while radius >= 0.5:
        core = eroded(filled, radius)
        if core.any():
            inside = core
            break
        radius *= 0.7
    row = int(np.flatnonzero(inside.any(axis=1))[-1])
    places = np.flatnonzero(inside[row])
    # The middle of the longest run of the lowest row.
    runs = np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)
    run = max(runs, key=len)
    return (float(run[0] + run[-1]) / 2.0 + 0.5) / columns, 1.0 - (row + 0.5) / rows


def eroded(filled: NDArray[np.bool_], radius: float) -> NDArray[np.bool_]:
    """Return the pixels whose whole neighbourhood of that radius is filled."""
    reach = int(radius)
    rows, columns = filled.shape
    around = np.zeros((rows + 2 * reach, columns + 2 * reach), dtype=bool)
    around[reach : reach + rows, reach : reach + columns] = filled
    mask = filled.copy()
    for down in range(-reach, reach + 1):
        for across in range(-reach, reach + 1):
            if hypot(down, across) <= radius:
                top, left = reach + down, reach + across
                mask &= around[top : top + rows, left : left + columns]
    return mask
