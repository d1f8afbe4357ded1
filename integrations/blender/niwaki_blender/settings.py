"""The settings of the panel, stored with the scene."""

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
from niwaki.fitting.in_blender import sockets

from . import conversion, permissions
from .order import Order, Triple, direction


@cache
def gallery_models() -> tuple[tuple[str, str], ...]:
    """List names and titles of the gallery's models of solids."""
    # The gallery takes a moment to load, so Blender's start does not load it.
    from niwaki import gallery

    return tuple((entry.name, entry.title) for entry in gallery.entries() if entry.target_name is not None)


def _models(settings: Any, context: Any, text: str) -> list[tuple[str, str]]:
    return [entry for entry in gallery_models() if text in entry[0]]


def _modifiers(settings: Any, context: Any, text: str) -> list[str]:
    obj = settings.fit_object or context.object
    rows = [] if obj is None else [entry.name for entry in obj.modifiers if sockets.is_node_tree(entry)]
    return [name for name in rows if text.lower() in name.lower()]


def _is(kind: str) -> Any:
    return lambda settings, obj: obj.type == kind


class Settings(bpy.types.PropertyGroup):
    """The settings of the panel."""

    model: StringProperty(
        name="Model", description="A model of the gallery", default="spaceship", search=_models
    )
    model_file: StringProperty(
        name="File",
        description="A file with your own models, instead of a gallery model",
        subtype="FILE_PATH",
    )
    function: StringProperty(
        name="Function", description="The model in the file, if the file has several models"
    )
    arguments: StringProperty(
        name="Arguments", description='The model\'s arguments, as JSON: {"storeys": 5}', default="{}"
    )
    target: PointerProperty(
        name="Target",
        description="The mesh to fill. The model grows from its origin. Without a target, the model's usual target",
        type=bpy.types.Object,
        poll=_is("MESH"),
    )
    obstacles: PointerProperty(
        name="Obstacles",
        description="Collection of meshes that the model avoids",
        type=bpy.types.Collection,
    )
    use_floor: BoolProperty(name="Floor", description="Keep all parts above a floor")
    floor: FloatProperty(name="Height", description="Height of the floor", subtype="DISTANCE")
    camera: PointerProperty(
        name="Camera",
        description="Camera of the silhouette or the shadow",
        type=bpy.types.Object,
        poll=_is("CAMERA"),
    )
    silhouette: PointerProperty(
        name="Silhouette",
        description="Image whose light pixels the result covers, as seen by the camera",
        type=bpy.types.Image,
    )
    light: PointerProperty(
        name="Light",
        description="Light that casts the shadow",
        type=bpy.types.Object,
        poll=_is("LIGHT"),
    )
    shadow: PointerProperty(
        name="Shadow",
        description="Image whose light pixels the shadow of the result covers",
        type=bpy.types.Image,
    )
    receiver: PointerProperty(
        name="Falls on",
        description="Mesh that receives the shadow",
        type=bpy.types.Object,
        poll=_is("MESH"),
    )
    count: IntProperty(name="Results", description="Number of results that differ", default=1, min=1, max=48)
    effort: FloatProperty(
        name="Effort",
        description="Factor of the usual work of a search",
        default=1.0,
        min=0.1,
        max=64.0,
    )
    seed: IntProperty(name="Seed", description="Seed of all random choices", default=1, min=0)

    fit_object: PointerProperty(
        name="Object",
        description="The object whose Geometry Nodes modifier is fitted. Default: the active object",
        type=bpy.types.Object,
        poll=lambda settings, obj: any(map(sockets.is_node_tree, obj.modifiers)),
    )
    fit_modifier: StringProperty(
        name="Modifier",
        description="The Geometry Nodes modifier, if the object has several",
        search=_modifiers,
    )
    evaluations: IntProperty(
        name="Evaluations",
        description="How often a fit evaluates the node tree",
        default=300,
        min=1,
        max=10_000,
    )

    def file(self) -> Path | None:
        """Return the file of models, if it is set."""
        return Path(bpy.path.abspath(self.model_file)).resolve() if self.model_file else None

    def order(self, context: bpy.types.Context, count: int = 0) -> Order:
        """Make the order of a search; `count` 0 takes the number of results of the panel.

        Raises
        ------
        ValueError
            A setting is missing or cannot be read.
        permissions.UntrustedFileError
            Only the .blend names the file of models.
        """
        file, reference = self.file(), self.model
        if file is not None:
            permissions.check(file)
            reference = f"{file}:{self.function}" if self.function else str(file)
        try:
            arguments = json.loads(self.arguments or "{}")
        except ValueError as error:
            raise ValueError(f"The arguments are not JSON: {error}") from None
        if not isinstance(arguments, dict):
            raise ValueError('The arguments are not a table: write {"name": value}')
        origin = (0.0, 0.0, 0.0) if self.target is None else tuple(self.target.matrix_world.translation)
        goals = self.goals(context, origin)
        return Order(reference, goals, origin, arguments, count or self.count, self.effort, self.seed)

    def goals(
        self,
        context: bpy.types.Context,
        origin: Triple = (0.0, 0.0, 0.0),
        but: bpy.types.Object | None = None,
    ) -> dict[str, Any]:
        """Collect options of `niwaki.targets.asks`, in scene units from an origin; `but` is no obstacle."""
        goals: dict[str, Any] = {}
        if self.target is not None:
            goals["target"] = conversion.mesh(self.target, context).target(origin)
        if self.obstacles is not None:
            meshes = [obj for obj in self.obstacles.all_objects if obj not in (self.target, but)]
            meshes = [obj for obj in meshes if obj.type == "MESH"]
            goals["avoid"] = [conversion.mesh(obj, context).target(origin) for obj in meshes]
        if self.use_floor:
            goals["floor"] = self.floor - origin[2]
        if self.silhouette is not None:
            goals["match_image"] = conversion.mask(self.silhouette)
        if self.shadow is not None:
            goals["match_shadow"] = conversion.mask(self.shadow)
            if self.light is not None:
                goals["light"] = direction(conversion.light(self.light))
            if self.receiver is not None:
                goals["receiver"] = conversion.mesh(self.receiver, context).receiver(origin)
        if self.camera is not None:
            pictures = [image for image in (self.silhouette, self.shadow) if image is not None]
            for image in pictures:
                conversion.check_shape(image, context.scene)
            if pictures:
                goals["camera"] = conversion.eye(self.camera, context.scene).camera(origin)
        return goals


def register() -> None:
    """Add the settings to scenes."""
    bpy.utils.register_class(Settings)
    bpy.types.Scene.niwaki_settings = PointerProperty(type=Settings)


def unregister() -> None:
    """Remove the settings."""
    del bpy.types.Scene.niwaki_settings
    bpy.utils.unregister_class(Settings)
