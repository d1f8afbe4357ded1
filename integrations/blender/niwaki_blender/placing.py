"""Results as collections of objects: the parts of a GLB below an empty that moves them all."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

import addon_utils
import bpy
import numpy as np

from . import grid, keeping
from .asking import Mesh
from .growing import Grown

#: What the best so far is called.
BEST = "niwaki: best so far"


def place(
    context: bpy.types.Context,
    grown: Grown,
    name: str,
    held: Collection[str] = (),
    at: Sequence[float] = (0.0, 0.0, 0.0),
) -> bpy.types.Collection:
    """Put results into a new collection of the scene; several stand in a grid.

    Parameters
    ----------
    name
        Of the collection.
    held
        Addresses of parts that are marked as held.
    at
        Where the model's origin stands in the first one.
    """
    run = bpy.data.collections.new(name)
    context.scene.collection.children.link(run)
    keeping.keep_run(run, grown, at)
    handles = [
        _result(context, run, grown, number, f"{name} #{number}", held) for number in range(len(grown.files))
    ]
    context.view_layer.update()
    sizes = [_size(handle) for handle in handles]
    for handle, (x, y) in zip(handles, grid.places(sizes), strict=True):
        handle.location = (at[0] + x, at[1] + y, at[2])
    context.view_layer.update()
    return run


def show_best(context: bpy.types.Context, best: Mesh, at: Sequence[float]) -> None:
    """Show the best so far as one object; it is in the way of nothing, and is removed when the search has ended."""
    hide_best()
    data = bpy.data.meshes.new(BEST)
    data.from_pydata(best.vertices.tolist(), [], best.faces.tolist())
    thing = bpy.data.objects.new(BEST, data)
    thing.location, thing.hide_select, thing.hide_render = at, True, True
    context.scene.collection.objects.link(thing)


def hide_best() -> None:
    """Remove the best so far."""
    data = bpy.data.meshes.get(BEST)
    if data is not None:
        for thing in [one for one in bpy.data.objects if one.data == data]:
            bpy.data.objects.remove(thing)
        bpy.data.meshes.remove(data)


def handle_of(result: bpy.types.Collection) -> bpy.types.Object | None:
    """The empty that moves a result."""
    return next((thing for thing in result.objects if thing.parent is None), None)


def _result(
    context: bpy.types.Context,
    run: bpy.types.Collection,
    grown: Grown,
    number: int,
    name: str,
    held: Collection[str],
) -> bpy.types.Object:
    """One result, and the empty that moves it."""
    collection = bpy.data.collections.new(name)
    run.children.link(collection)
    keeping.keep_result(collection, grown, number)
    handle = bpy.data.objects.new(name, None)
    collection.objects.link(handle)
    for thing in _imported(context, grown.files[number]):
        for other in list(thing.users_collection):
            other.objects.unlink(thing)
        collection.objects.link(thing)
        if thing.parent is None:
            thing.parent = handle
        if thing.get(keeping.ADDRESS) in held:
            thing[keeping.HELD] = True
    return handle


def _imported(context: bpy.types.Context, file: Path) -> list[bpy.types.Object]:
    """The objects of a GLB, with materials that the .blend may have already."""
    if not addon_utils.check("io_scene_gltf2")[1]:
        addon_utils.enable("io_scene_gltf2")
    if context.object is not None and context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    things, materials = set(bpy.data.objects), set(bpy.data.materials)
    before = context.scene.get("niwaki")
    bpy.ops.import_scene.gltf(filepath=str(file))
    # The choices of calls without an object: the collection has all choices.
    if before is None and "niwaki" in context.scene:
        del context.scene["niwaki"]
    for material in set(bpy.data.materials) - materials:
        same = bpy.data.materials.get(material.name.rpartition(".")[0])
        if same is not None and _look(same) == _look(material):
            material.user_remap(same)
            bpy.data.materials.remove(material)
    return [thing for thing in bpy.data.objects if thing not in things]


def _look(material: bpy.types.Material) -> tuple[float, ...]:
    """Colour, roughness and metal of a material."""
    shader = material.node_tree and material.node_tree.nodes.get("Principled BSDF")
    if not shader:
        return (*material.diffuse_color, material.roughness, material.metallic)
    inputs = shader.inputs
    color = inputs["Base Color"].default_value
    return (*color, inputs["Roughness"].default_value, inputs["Metallic"].default_value)


def _size(handle: bpy.types.Object) -> tuple[float, float]:
    """The extent of what a handle moves, along x and y."""
    corners = [
        np.array(thing.bound_box) @ np.array(thing.matrix_world)[:2, :3].T
        + np.array(thing.matrix_world)[:2, 3]
        for thing in handle.children_recursive
        if thing.type == "MESH"
    ]
    if not corners:
        return (0.0, 0.0)
    x, y = np.ptp(np.concatenate(corners), axis=0).tolist()
    return (x, y)
