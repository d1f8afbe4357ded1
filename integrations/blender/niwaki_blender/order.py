"""Orders: the goals of a search as values for a worker process.

Points of meshes and eyes are Blender's, with z up. A model grows from its origin, whose place in Blender is
`Order.origin`. The goals are options of `niwaki.targets.asks`, in scene units from this origin.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import niwaki as nw
import numpy as np
from niwaki.search.data import Writer
from niwaki.studio.messages import GrowValues, Settings
from numpy.typing import NDArray

from . import axes

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Mesh:
    """A mesh of Blender in world space.

    Attributes
    ----------
    vertices : (n, 3) float64
    faces : (m, 3) int64
        Triangles, counter-clockwise seen from outside.
    """

    name: str
    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]

    def target(self, origin: Triple = (0.0, 0.0, 0.0)) -> nw.Target:
        """Return the solid as a target, in scene units from an origin."""
        with warnings.catch_warnings():
            # Blender shows holes itself.
            warnings.simplefilter("ignore")
            return nw.Target(axes.to_scene(self.vertices - origin), self.faces, self.name)

    def receiver(self, origin: Triple) -> nw.Receiver:
        """Return the surface as a receiver, in scene units from an origin."""
        return nw.Receiver(axes.to_scene(self.vertices - origin), self.faces, self.name)


@dataclass(frozen=True)
class Eye:
    """A camera of Blender, or the light that casts a shadow.

    Attributes
    ----------
    forward, up
        Directions of the view.
    fov
        Vertical field of view, degrees; None for an orthographic camera.
    height
        The height of an orthographic view.
    near
        The near clipping distance.
    """

    position: Triple
    forward: Triple
    up: Triple
    fov: float | None = None
    height: float = 0.0
    near: float = 0.1

    def camera(self, origin: Triple = (0.0, 0.0, 0.0)) -> nw.Camera:
        """Return the camera, in scene units from an origin."""
        position = axes.to_scene(np.subtract(self.position, origin))
        forward, up = axes.to_scene(self.forward), axes.to_scene(self.up)
        look_at = (position + forward).tolist()
        if self.fov is None:
            return nw.Camera.orthographic(position.tolist(), look_at, up.tolist(), height=self.height)
        return nw.Camera.perspective(
            position.tolist(), look_at, up.tolist(), fov_degrees=self.fov, near=self.near
        )


def direction(way: Triple) -> Triple:
    """Convert a direction of Blender to a scene."""
    x, y, z = axes.to_scene(way).tolist()
    return x, y, z


#: The settings that a picture needs, and the message if they are missing.
NEEDED = {
    "match_image": ({"camera"}, "The silhouette has no camera: choose a camera"),
    "match_shadow": (
        {"light", "receiver"},
        "The shadow needs a light and a mesh that receives it: choose both",
    ),
}


@dataclass(frozen=True)
class Order:
    """The order of a search, from the settings of the panel.

    Attributes
    ----------
    model
        A name of the gallery, or `file.py:function`.
    goals
        Options of `niwaki.targets.asks`, in scene units from the origin.
    origin
        The place of the model's origin.
    effort
        The factor of the usual number of search rounds.
    count
        The number of results that differ.
    """

    model: str
    goals: Mapping[str, Any] = field(default_factory=dict)
    origin: Triple = (0.0, 0.0, 0.0)
    arguments: dict[str, Any] = field(default_factory=dict)
    count: int = 1
    effort: float = 1.0
    seed: int = 1

    def job(self) -> GrowValues:
        """Make the job for the worker.

        Raises
        ------
        ValueError
            A picture has no camera or no light.
        """
        for picture, (needed, text) in NEEDED.items():
            if picture in self.goals and not needed <= self.goals.keys():
                raise ValueError(text)
        write = Writer("inside")
        return GrowValues(
            model=self.model,
            arguments=self.arguments,
            options={name: write(value) for name, value in self.goals.items()},
            settings=Settings(count=self.count, effort=self.effort),
            run=0,
            seed=self.seed,
            file="",
        )
