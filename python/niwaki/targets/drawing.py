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

#: How far inside of the ink a start is, as a share of the image's longer side.
DEEP = 0.035


@dataclass(frozen=True, eq=False)
class Drawing:
    """A drawing, and where to start.

    Attributes
    ----------
    name : str
        For captions and messages.
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
        """A drawing from a file, a Pillow image or an array; it starts at the lowest point that lies well in the ink.

        Parameters
        ----------
        image
            Dark ink on white or transparent paper.
        pixels
            Of the longer side: a larger image is made smaller. As it is when None.
        """
        greys = targets.images.ink(image, pixels)
        return cls(targets.images.name_of(image), greys, lowest(greys < 255))

    def window(self, window: Window) -> Window:
        """The part of the plane that the drawing fills: `window`, wider or higher so that pixels are square.

        It grows to both sides, and upwards.
        """
        (left, low), (right, high) = check_window(window)
        rows, columns = self.greys.shape
        wide, tall = right - left, high - low
        if columns * tall > rows * wide:
            more = 0.5 * (tall * columns / rows - wide)
            return (left - more, low), (right + more, high)
        return (left, low), (right, low + wide * rows / columns)

    def place(self, window: Window) -> tuple[float, float, Point]:
        """The start in the plane, and the direction: the arguments of a model that follows a drawing."""
        (left, low), (right, high) = self.window(window)
        x, y = self.start
        return left + x * (right - left), low + y * (high - low), self.ahead

    def score(self, window: Window, **settings: Any) -> Score:
        """How well a scene draws it; `settings` are those of `match_drawing`."""
        return match_drawing(self.greys, self.window(window), **settings)

    def mirrored(self) -> Drawing:
        """The same, with left and right exchanged."""
        (x, y), (u, v) = self.start, self.ahead
        greys = np.ascontiguousarray(self.greys[:, ::-1])
        return replace(self, name=f"{self.name}, mirrored", greys=greys, start=(1.0 - x, y), ahead=(-u, v))


def lowest(filled: NDArray[np.bool_], deep: float = DEEP) -> Point:
    """The lowest pixel that has ink all around it, as shares of the image from its lower left corner.

    Parameters
    ----------
    filled
        (rows, columns): where there is ink.
    deep
        How far around, as a share of the longer side; less where no ink is that thick.
    """
    rows, columns = filled.shape
    inside, radius = filled, deep * max(rows, columns)
    while radius >= 0.5:
        found = eroded(filled, radius)
        if found.any():
            inside = found
            break
        radius *= 0.7
    row = int(np.flatnonzero(inside.any(axis=1))[-1])
    places = np.flatnonzero(inside[row])
    # The middle of the longest run of the lowest row.
    runs = np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)
    run = max(runs, key=len)
    return (float(run[0] + run[-1]) / 2.0 + 0.5) / columns, 1.0 - (row + 0.5) / rows


def eroded(filled: NDArray[np.bool_], radius: float) -> NDArray[np.bool_]:
    """The pixels whose whole neighbourhood of that radius is filled."""
    reach = int(radius)
    rows, columns = filled.shape
    around = np.zeros((rows + 2 * reach, columns + 2 * reach), dtype=bool)
    around[reach : reach + rows, reach : reach + columns] = filled
    kept = filled.copy()
    for down in range(-reach, reach + 1):
        for across in range(-reach, reach + 1):
            if hypot(down, across) <= radius:
                top, left = reach + down, reach + across
                kept &= around[top : top + rows, left : left + columns]
    return kept
