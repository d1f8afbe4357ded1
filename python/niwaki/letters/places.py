"""Places from which a shape can be grown: points deep in its ink, and directions in which the ink continues."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from niwaki.targets.drawing import eroded, lowest

#: Distances of a place from the edge of the ink, and from another place, in pixels.
DEEP, APART = 2.0, 6.0
#: The most places, the tested directions, the most directions of a place, and the least pixels of ink along one.
MOST, TURNS, FORKS, REACH = 6, 16, 3, 6


@dataclass(frozen=True)
class Place:
    """A point, in pixels from the lower left corner of the image, and a direction."""

    x: float
    y: float
    ahead: tuple[float, float]


def places(filled: NDArray[np.bool_]) -> list[Place]:
    """Return the places of a shape (rows, columns): its lowest point, then the points farthest from earlier ones."""
    rows, columns = filled.shape
    deep = eroded(filled, DEEP)
    down, across = np.nonzero(deep if deep.any() else filled)
    points = np.stack([across + 0.5, rows - down - 0.5], axis=1)
    x, y = lowest(filled)
    chosen = [(x * columns, y * rows)]
    while len(chosen) < MOST:
        away = np.min([np.hypot(*(points - place).T) for place in np.array(chosen)], axis=0)
        if away.max() < APART:
            break
        chosen.append((float(points[away.argmax(), 0]), float(points[away.argmax(), 1])))
    return [Place(x, y, ahead) for x, y in chosen for ahead in _ahead(filled, x, y)]


def _ahead(filled: NDArray[np.bool_], x: float, y: float) -> list[tuple[float, float]]:
    """Return the directions in which the ink reaches farther than in the neighbouring ones, the longest first."""
    rays = [(cos(2.0 * pi * k / TURNS), sin(2.0 * pi * k / TURNS)) for k in range(TURNS)]
    reach = [_reach(filled, x, y, ray) for ray in rays]
    best = [k for k in range(TURNS) if reach[k] >= max(reach[k - 1], reach[(k + 1) % TURNS], REACH)]
    ranked = sorted(best or [int(np.argmax(reach))], key=lambda k: -reach[k])
    return [rays[k] for k in ranked[:FORKS]]


def _reach(filled: NDArray[np.bool_], x: float, y: float, ray: tuple[float, float]) -> int:
    """Return the pixels of ink along a ray."""
    rows, columns = filled.shape
    for far in range(1, int(hypot(rows, columns))):
        column, row = int(x + far * ray[0]), int(rows - (y + far * ray[1]))
        if not (0 <= column < columns and 0 <= row < rows and filled[row, column]):
            return far
    return 0
