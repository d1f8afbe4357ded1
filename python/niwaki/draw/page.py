"""The numbers of an SVG page: enough digits for its size, and small values wherever the scene is.

Programs that show SVG use numbers of 32 bits. A page far from the origin (`niwaki.draw.far`) would lose too many
digits. Such a page begins at 0, and the attribute `data-origin` of the file has the scene point of its upper left
corner. Many programs show a pixel for each unit if a page has no size. So a page gets a size if this would be less than
a pixel or larger than any picture.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from niwaki.draw.far import is_far
from niwaki.draw.limits import LARGEST

#: The least digits of the longer side of a page, and the least decimals of a number.
DIGITS, DECIMALS = 6, 3

#: Pixels of the longer side of a page that gets a size.
SHOWN = 600.0

Point = tuple[float, float]


@dataclass(frozen=True)
class Page:
    """A page: the part of the plane that a file shows.

    Attributes
    ----------
    low, high : (x, y)
        Corners, scene units, y upwards.
    """

    low: Point
    high: Point

    @property
    def width(self) -> float:
        """Width in scene units."""
        return self.high[0] - self.low[0]

    @property
    def height(self) -> float:
        """Height in scene units."""
        return self.high[1] - self.low[1]

    @property
    def longer(self) -> float:
        """The longer side, scene units."""
        return max(self.width, self.height)

    @property
    def decimals(self) -> int:
        """The number of decimals of each number."""
        return max(DECIMALS, math.ceil(DIGITS - math.log10(self.longer))) if self.longer > 0.0 else DECIMALS

    @property
    def origin(self) -> Point:
        """The point of the scene at (0, 0) of the page."""
        return (self.low[0], self.high[1]) if is_far((self.low, self.high)) else (0.0, 0.0)

    def at(self, point: Point) -> Point:
        """Convert a point of the scene to the page, whose y axis points down."""
        (x, y), (left, top) = point, self.origin
        return x - left, top - y

    def number(self, length: float) -> str:
        """Write a length."""
        return f"{length:.{self.decimals}f}"

    def corners(self, points: list[Point]) -> str:
        """Write points of the scene in SVG's form: `x,y x,y`."""
        return " ".join(f"{self.number(x)},{self.number(y)}" for x, y in map(self.at, points))

    @property
    def attributes(self) -> str:
        """The attributes of the outermost element."""
        x, y = self.origin
        more = f' data-origin="{x!r} {y!r}"' if (x, y) != (0.0, 0.0) else ""
        if self.longer > 0.0 and not 1.0 <= self.longer <= LARGEST:
            wide, tall = (SHOWN * side / self.longer for side in (self.width, self.height))
            more += f' width="{wide:.3f}" height="{tall:.3f}"'
        left, top = self.at((self.low[0], self.high[1]))
        box = " ".join(map(self.number, (left, top, self.width, self.height)))
        return f'xmlns="http://www.w3.org/2000/svg" viewBox="{box}"{more}'
