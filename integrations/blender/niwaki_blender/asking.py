"""What is asked, as values that a worker process is sent.

All points are Blender's, with z up. A model grows from its origin; `Ask.origin` is where that is in Blender.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
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


@dataclass(frozen=True)
class Ask:
    """What a result should be like.

    Attributes
    ----------
    origin
        Where the model's origin stands.
    target
        What to fill.
    obstacles
        What nothing comes near.
    floor
        The height below which nothing reaches.
    silhouette, camera
        What the result looks like, (rows, columns), to a camera.
    shadow, light, receiver
        What shadow the result casts, (rows, columns), in which direction the light travels, and on what; it is seen
        by the camera, or along the light where there is none.
    """

    origin: Triple = (0.0, 0.0, 0.0)
    target: Mesh | None = None
    obstacles: Sequence[Mesh] = ()
    floor: float | None = None
    silhouette: NDArray[np.bool_] | None = None
    camera: Eye | None = None
    shadow: NDArray[np.bool_] | None = None
    light: Triple | None = None
    receiver: Mesh | None = None

    def score(self) -> nw.Score:
        """The sketches beside the target.

        Raises
        ------
        ValueError
            A picture comes without its camera, or without its light.
        niwaki.errors.NiwakiError
            A mesh or a picture cannot be used.
        """
        score = nw.Score()
        if self.floor is not None:
            score *= nw.floor(self.floor - self.origin[2])
        for obstacle in self.obstacles:
            score *= nw.avoid(obstacle.target(self.origin))
        if self.silhouette is not None:
            if self.camera is None:
                raise ValueError("The silhouette has no camera: choose the one that sees it")
            score *= nw.match_image(self.silhouette, self.camera.camera(self.origin))
        if self.shadow is not None:
            if self.light is None or self.receiver is None:
                raise ValueError("The shadow needs a light, and a mesh that it falls on: choose both")
            light = tuple(axes.to_scene(self.light).tolist())
            seen_by = None if self.camera is None else self.camera.camera(self.origin)
            score *= nw.match_shadow(self.shadow, light, self.receiver.receiver(self.origin), seen_by)
        return score


@dataclass(frozen=True)
class Order:
    """A search as the panel asks for it.

    Attributes
    ----------
    model
        A name of the gallery, or `file.py:function`.
    effort
        Rounds of the search, in its usual number.
    count
        How many results that differ.
    """

    model: str
    ask: Ask = Ask()
    arguments: dict[str, Any] = field(default_factory=dict)
    count: int = 1
    effort: float = 1.0
    seed: int = 1

    def job(self) -> GrowValues:
        """The worker's job; errors as of `Ask.score`."""
        write = Writer("inside")
        target = None if self.ask.target is None else write(self.ask.target.target(self.ask.origin))
        settings = Settings(count=self.count, effort=self.effort)
        score = self.ask.score().data(write)
        return GrowValues(
            model=self.model,
            arguments=self.arguments,
            target=target,
            score=score,
            settings=settings,
            run=0,
            seed=self.seed,
            file="",
        )
