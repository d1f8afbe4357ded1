"""Where a shape has its own frame: the origin and the axes about which a person would turn it.

box, cylinder, mesh, ellipse   its centre, and its own axes; the middle of a mesh that is far from its own origin
limb                           the middle of its first ring, y along the ring's direction
segment                        the middle of its first ring, y forward and z up
stroke                         its start, x towards its end
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki._engine import Shape
from niwaki.draw.far import is_far


@dataclass(frozen=True)
class Pivot:
    """A frame in the scene.

    Attributes
    ----------
    origin : (3,) float64
        Scene units.
    axes : (3, 3) float64
        Unit directions x, y and z as columns, right-handed.
    """

    origin: NDArray[np.float64]
    axes: NDArray[np.float64]


def pivot(shape: Shape) -> Pivot:
    """The frame of a shape."""
    data = json.loads(shape.data())
    turn, place = data["placement"]["rotation"]["columns"], _vector(data["placement"]["translation"])
    rotation = np.array([_vector(column) for column in turn]).T
    ((kind, solid),) = data["solid"].items()
    if kind == "limb":
        ring = solid["rings"][0]
        center, axes = _vector(ring["center"]), _shortest_turn(_vector(ring["normal"]))
    elif kind == "segment":
        ring = solid["frames"][0]
        forward, up = _vector(ring["forward"]), _vector(ring["up"])
        center, axes = _vector(ring["center"]), np.array([np.cross(forward, up), forward, up]).T
    elif kind == "stroke":
        start, end = (_vector(one["center"]) for one in solid["ends"])
        center, axes = start, _along(end - start)
    elif kind == "mesh" and is_far(shape.aabb() - place):
        return Pivot(np.mean(shape.aabb(), axis=0), rotation)
    else:
        center, axes = np.zeros(3), np.eye(3)
    return Pivot(place + rotation @ center, rotation @ axes)


def _vector(data: dict[str, Any]) -> NDArray[np.float64]:
    return np.array([data["x"], data["y"], data["z"]], dtype=np.float64)


def _shortest_turn(up: NDArray[np.float64]) -> NDArray[np.float64]:
    """The shortest turn of y into a unit direction (Moller and Hughes 1999)."""
    x, y, z = up
    if y < -1.0 + 1e-12:
        # A half turn, about x.
        return np.diag([1.0, -1.0, -1.0])
    h = 1.0 / (1.0 + y)
    return np.array([[1.0 - h * x * x, x, -h * x * z], [-x, y, -z], [-h * x * z, z, 1.0 - h * z * z]])


def _along(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    """A turn about z of x into a direction of the plane."""
    x, y, _ = direction / (float(np.linalg.norm(direction)) or 1.0)
    length = float(np.hypot(x, y))
    if length == 0.0:
        return np.eye(3)
    return np.array([[x / length, -y / length, 0.0], [y / length, x / length, 0.0], [0.0, 0.0, 1.0]])
