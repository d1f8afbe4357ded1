"""Scenes far from the origin, for example in the coordinates of a map.

Many programs and formats use numbers of 32 bits, about seven digits. A scene that is farther from the origin than `FAR`
times its own size would lose too many digits, so its files have an offset or more digits.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from niwaki._engine import FAR
from niwaki.draw.assembly import Assembly
from niwaki.errors.warned import warn


class FarSceneWarning(UserWarning):
    """A file has all digits of a scene far from the origin, but some programs do not read all of them."""


def distance(bounds: ArrayLike) -> float:
    """Compute the distance of the farthest coordinate from 0, in longest sides of the box `bounds`; 0 for a point."""
    low, high = np.asarray(bounds, dtype=np.float64)
    longest = float((high - low).max())
    return float(np.abs([low, high]).max()) / longest if longest > 0.0 else 0.0


def is_far(bounds: ArrayLike) -> bool:
    """Whether a box with these corners is far from the origin."""
    return distance(bounds) > FAR


def warn_of(scene: Assembly) -> None:
    """Warn that a file of plain coordinates has more digits than some programs read."""
    if is_far(scene.bounds):
        warn(
            f"the scene is {distance(scene.bounds):.2g} times as far from the origin as it is large: the file has all "
            f"digits, but programs with numbers of 32 bits, such as Blender, lose some of them; .glb has an offset, "
            f"which such programs keep; a scene near the origin does not need it",
            FarSceneWarning,
        )
