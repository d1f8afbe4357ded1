"""Blender's coordinates, with z up, and those of a scene, with y up.

The turn is the one of the glTF importer, so that what grew around a mesh is imported around it. One unit of Blender is
one scene unit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def to_scene(points: ArrayLike) -> NDArray[np.float64]:
    """Points or directions of Blender in the scene, (n, 3) or (3,)."""
    x, y, z = np.moveaxis(np.asarray(points, dtype=np.float64), -1, 0)
    return np.stack([x, z, -y], axis=-1)


def to_blender(points: ArrayLike) -> NDArray[np.float64]:
    """Points or directions of the scene in Blender, (n, 3) or (3,)."""
    x, y, z = np.moveaxis(np.asarray(points, dtype=np.float64), -1, 0)
    return np.stack([x, -z, y], axis=-1)
