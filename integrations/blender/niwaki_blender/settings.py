"""What the panel asks, stored with the scene."""

import json
from functools import cache
from pathlib import Path
from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import naming, reading
from .asking import Order, Triple, direction


@cache
def gallery_models() -> tuple[tuple[str, str], ...]:
    """Names and titles of the gallery's models that grow in space."""
    # Reading the gallery takes a moment, which Blender's start need not wait for.
    from niwaki import gallery

    return tuple((one.name, one.title) for one in gallery.entries() if one.target_name is not None)


def _models(settings: Any, context: Any, text: str) -> list[tuple[str, str]]:
    return [one for one in gallery_models() if text in one[0]]


def _is(kind: str) -> Any:
    return lambda settings, thing: thing.type == kind


class Settings(bpy.types.PropertyGroup):
    """What the panel asks."""

    model: StringProperty(
        name="Model", description="A model of the gallery", default="spaceship", search=_models
    )
    model_file: StringProperty(
        name="File", description="A file of your own models, in place of the gallery's", subtype="FILE_PATH"
    )
    function: StringProperty(name="Function", description="Its model, where it has several")
    arguments: StringProperty(
        name="Arguments", description='The model\'s arguments, as JSON: {"storeys": 5}', default="{}"
    )
    target: PointerProperty(
        name="Target",
        description="The mesh to fill: the model grows from its origin. Without one, what is usual for the model",
        type=bpy.types.Object,
        poll=_is("MESH"),
    )
    obstacles: PointerProperty(
        name="Obstacles",
        description="Nothing comes near the meshes of this collection",
        type=bpy.types.Collection,
    )
    use_floor: BoolProperty(name="Floor", description="Nothing reaches below it")
    floor: FloatProperty(name="Height", description="Of the floor", subtype="DISTANCE")
    camera: PointerProperty(
        name="Camera",
        description="Who sees the silhouette, or the shadow",
        type=bpy.types.Object,
        poll=_is("CAMERA"),
    )
    silhouette: PointerProperty(
        name="Silhouette",
        description="The result covers what is light in this image, seen by the camera",
        type=bpy.types.Image,
    )
    light: PointerProperty(
        name="Light",
        description="Whose direction casts the shadow",
        type=bpy.types.Object,
        poll=_is("LIGHT"),
    )
    shadow: PointerProperty(
        name="Shadow",
        description="The result's shadow covers what is light in this image",
        type=bpy.types.Image,
    )
    receiver: PointerProperty(
        name="Falls on",
        description="The mesh that the shadow falls on",
        type=bpy.types.Object,
        poll=_is("MESH"),
    )
    count: IntProperty(name="Results", description="How many that differ", default=1, min=1, max=48)
    effort: FloatProperty(
        name="Effort", description="Rounds of the search, in its usual number", default=1.0, min=0.1, max=64.0
    )
    seed: IntProperty(name="Seed", description="Decides every random choice", default=1, min=0)

    def file(self) -> Path | None:
        """The file of models, if one is named."""
        return Path(bpy.path.abspath(self.model_file)).resolve() if self.model_file else None

    def order(self, context: bpy.types.Context, count: int = 0) -> Order:
        """What is asked; `count` results, those of the panel where it is 0.

        Raises
        ------
        ValueError
            Something is missing, or cannot be read.
        naming.Unnamed
            The file of models was named by the .blend alone.
        """
        file, reference = self.file(), self.model
        if file is not None:
            naming.check(file)
            reference = f"{file}:{self.function}" if self.function else str(file)
        try:
            arguments = json.loads(self.arguments or "{}")
        except ValueError as error:
            raise ValueError(f"The arguments are no JSON: {error}") from None
        if not isinstance(arguments, dict):
            raise ValueError('The arguments are no table: write {"name": value}')
        origin = (0.0, 0.0, 0.0) if self.target is None else tuple(self.target.matrix_world.translation)
        asked = self._asked(context, origin)
        return Order(reference, asked, origin, arguments, count or self.count, self.effort, self.seed)

    def _asked(self, context: bpy.types.Context, origin: Triple) -> dict[str, Any]:
        """Options of `niwaki.targets.asks`, in scene units from an origin."""
        found: dict[str, Any] = {}
        if self.target is not None:
            found["target"] = reading.mesh(self.target, context).target(origin)
        if self.obstacles is not None:
            things = [one for one in self.obstacles.all_objects if one.type == "MESH" and one != self.target]
            found["avoid"] = [reading.mesh(one, context).target(origin) for one in things]
        if self.use_floor:
            found["floor"] = self.floor - origin[2]
        if self.silhouette is not None:
            found["match_image"] = reading.mask(self.silhouette)
        if self.shadow is not None:
            found["match_shadow"] = reading.mask(self.shadow)
            if self.light is not None:
                found["light"] = direction(reading.light(self.light))
            if self.receiver is not None:
                found["receiver"] = reading.mesh(self.receiver, context).receiver(origin)
        if self.camera is not None:
            pictures = [one for one in (self.silhouette, self.shadow) if one is not None]
            for one in pictures:
                reading.check_shape(one, context.scene)
            if pictures:
                found["camera"] = reading.eye(self.camera, context.scene).camera(origin)
        return found


def register() -> None:
    """Add them to scenes."""
    bpy.utils.register_class(Settings)
    bpy.types.Scene.niwaki_settings = PointerProperty(type=Settings)


def unregister() -> None:
    """Remove them."""
    del bpy.types.Scene.niwaki_settings
    bpy.utils.unregister_class(Settings)
