"""Coordinates of Blender, with z up, and of scenes, with y up.

The rotation is that of the glTF importer, so that a result is imported at the mesh into which it grew. A unit of
Blender is a scene unit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def to_scene(points: ArrayLike) -> NDArray[np.float64]:
    """Convert points or directions of Blender to a scene, (n, 3) or (3,)."""
    x, y, z = np.moveaxis(np.asarray(points, dtype=np.float64), -1, 0)
    return np.stack([x, z, -y], axis=-1)


def to_blender(points: ArrayLike) -> NDArray[np.float64]:
    """Convert points or directions of a scene to Blender, (n, 3) or (3,)."""
    x, y, z = np.moveaxis(np.asarray(points, dtype=np.float64), -1, 0)
    return np.stack([x, -z, y], axis=-1)
