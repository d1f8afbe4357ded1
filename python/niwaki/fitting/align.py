"""Place, turn and size of a generator's mesh as further parameters, for targets in other units, axes or places.

The mesh is put into the middle of the target, with the target's longest side, whichever of its axes is up. From there
it moves, turns about the vertical and changes its size within the ranges below.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.targets.target import Target
from niwaki.words.distributions import Uniform

#: The parameters: shares of the target's longest side, degrees, and the logarithm to base 2 of the relative size.
PARAMETERS: dict[str, Any] = {
    "align.up": ["y", "z"],
    "align.x": Uniform(-0.25, 0.25),
    "align.y": Uniform(-0.25, 0.25),
    "align.z": Uniform(-0.25, 0.25),
    "align.turn": Uniform(-180.0, 180.0),
    "align.size": Uniform(-1.0, 1.0),
}


def aligned(vertices: NDArray[np.float64], target: Target, values: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return the vertices of a mesh, placed beside a target by the values of `PARAMETERS`."""
    if not len(vertices):
        return vertices
    # A mesh whose z is up lies on its back where y is up.
    points = vertices[:, [0, 2, 1]] * (1.0, 1.0, -1.0) if values["align.up"] == "z" else vertices
    low, high = points.min(axis=0), points.max(axis=0)
    goal = target.bounds
    side = float((goal[1] - goal[0]).max())
    scale = side / max(float((high - low).max()), 1e-300) * 2.0 ** values["align.size"]
    angle = radians(values["align.turn"])
    turn = np.array([[cos(angle), 0.0, sin(angle)], [0.0, 1.0, 0.0], [-sin(angle), 0.0, cos(angle)]])
    move = side * np.array([values["align.x"], values["align.y"], values["align.z"]])
    return np.asarray((points - (low + high) / 2) @ turn.T * scale + (goal[0] + goal[1]) / 2 + move)
