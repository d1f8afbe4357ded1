"""How much of each part of a target a scene has: shares between 0 and 1, which the searches do not see.

A part of a solid is a set of points, the middles of the cells inside it; a point counts when it is in a filled cell of
the scene. A part of an image is a mask; a pixel counts when it is as wanted.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from niwaki import Target, _engine
from niwaki.draw.scene import Scene
from niwaki.targets.examples.lofts import Mesh
from niwaki.targets.sketches import View
from numpy.typing import NDArray

Points = NDArray[np.float64]
Mask = NDArray[np.bool_]


def inside(mesh: Mesh, voxel: float) -> Points:
    """The middles of the cells inside a closed mesh, (n, 3)."""
    return middles(_engine.Target(*mesh, voxel), voxel)


def cells_of(target: Target, voxel: float) -> Points:
    """Return the measures of a target."""
    return middles(_engine.Target(target.vertices, target.faces, voxel), voxel)


def middles(grid: _engine.Target, voxel: float) -> Points:
    """The middles of the filled cells of a grid, (n, 3)."""
    return np.asarray(grid.domain[0]) + voxel * (np.argwhere(grid.cells()) + 0.5)


def covered(scene: Scene, parts: Mapping[str, Points], voxel: float) -> dict[str, float]:
    """The share of the points of each part that are in cells of this size that the scene fills."""
    if len(scene) == 0:
        return dict.fromkeys(parts, 0.0)
    grid = _engine.Target(*scene.merged(fine=False), voxel)
    low, cells = np.asarray(grid.domain[0]), grid.cells()

    def share(points: Points) -> float:
        index = np.floor((points - low) / voxel).astype(np.int64)
        is_near = ((index >= 0) & (index < cells.shape)).all(axis=1)
        return float(cells[tuple(index[is_near].T)].sum() / len(points))

    return {name: share(points) for name, points in parts.items()}


def agreeing(scene: Scene, view: View, parts: Mapping[str, Mask]) -> dict[str, float]:
    """The share of the pixels that are wanted in each part and are on; and `all`, those that are right in the image."""
    drawn = view.mask(scene)
    shares = {name: float(drawn[mask & view.image].mean()) for name, mask in parts.items()}
    return shares | {"all": float((drawn == view.image).mean())}
