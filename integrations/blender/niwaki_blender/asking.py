"""What is asked, as values that a worker process is sent.

Points of meshes and eyes are Blender's, with z up. A model grows from its origin; `Order.origin` is where that is in
Blender. What a search is asked is in scene units from there, by the options of `niwaki.targets.asks`.
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
    """A mesh of Blender where it stands.

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
        """The solid, in scene units from an origin."""
        with warnings.catch_warnings():
            # Blender's own checks show holes.
            warnings.simplefilter("ignore")
            return nw.Target(axes.to_scene(self.vertices - origin), self.faces, self.name)

    def receiver(self, origin: Triple) -> nw.Receiver:
        """The surface, in scene units from an origin."""
        return nw.Receiver(axes.to_scene(self.vertices - origin), self.faces, self.name)


@dataclass(frozen=True)
class Eye:
    """A camera of Blender, or the light that casts a shadow.

    Attributes
    ----------
    forward, up
        Directions of its view.
    fov
        Vertical, degrees; None where it is orthographic.
    height
        Of what an orthographic one shows.
    near
        What is nearer is not seen.
    """

    position: Triple
    forward: Triple
    up: Triple
    fov: float | None = None
    height: float = 0.0
    near: float = 0.1

    def camera(self, origin: Triple = (0.0, 0.0, 0.0)) -> nw.Camera:
        """The camera, in scene units from an origin."""
        position = axes.to_scene(np.subtract(self.position, origin))
        forward, up = axes.to_scene(self.forward), axes.to_scene(self.up)
        look_at = (position + forward).tolist()
        if self.fov is None:
            return nw.Camera.orthographic(position.tolist(), look_at, up.tolist(), height=self.height)
        return nw.Camera.perspective(
            position.tolist(), look_at, up.tolist(), fov_degrees=self.fov, near=self.near
        )


def direction(way: Triple) -> Triple:
    """A direction of Blender in a scene."""
    x, y, z = axes.to_scene(way).tolist()
    return x, y, z


#: What a picture is nothing without, in the panel's words.
NEEDED = {
    "match_image": ({"camera"}, "The silhouette has no camera: choose the one that sees it"),
    "match_shadow": (
        {"light", "receiver"},
        "The shadow needs a light, and a mesh that it falls on: choose both",
    ),
}


@dataclass(frozen=True)
class Order:
    """A search as the panel asks for it.

    Attributes
    ----------
    model
        A name of the gallery, or `file.py:function`.
    asked
        What the result should be like: options of `niwaki.targets.asks`, in scene units from the origin.
    origin
        Where the model's origin stands.
    effort
        Rounds of the search, in its usual number.
    count
        How many results that differ.
    """

    model: str
    asked: Mapping[str, Any] = field(default_factory=dict)
    origin: Triple = (0.0, 0.0, 0.0)
    arguments: dict[str, Any] = field(default_factory=dict)
    count: int = 1
    effort: float = 1.0
    seed: int = 1

    def job(self) -> GrowValues:
        """The worker's job.

        Raises
        ------
        ValueError
            A picture comes without its camera, or without its light.
        """
        for picture, (others, text) in NEEDED.items():
            if picture in self.asked and not others <= self.asked.keys():
                raise ValueError(text)
        write = Writer("inside")
        return GrowValues(
            model=self.model,
            arguments=self.arguments,
            options={name: write(value) for name, value in self.asked.items()},
            settings=Settings(count=self.count, effort=self.effort),
            run=0,
            seed=self.seed,
            file="",
        )
