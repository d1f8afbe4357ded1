"""Results as collections of objects: the parts of a GLB below an empty that moves all of them."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

import addon_utils
import bpy
import numpy as np

from . import grid, storage
from .growth import GrowthOutcome
from .order import Mesh

#: The name of the best result so far.
BEST = "niwaki: best so far"


def place(
    context: bpy.types.Context,
    outcome: GrowthOutcome,
    name: str,
    held: Collection[str] = (),
    at: Sequence[float] = (0.0, 0.0, 0.0),
) -> bpy.types.Collection:
    """Place results in a new collection of the scene; several results stand in a grid.

    Parameters
    ----------
    name
        The name of the collection.
    held
        Addresses of parts to mark as held.
    at
        The place of the model's origin in the first result.
    """
    run = bpy.data.collections.new(name)
    context.scene.collection.children.link(run)
    storage.store_run(run, outcome, at)
    handles = [
        _result(context, run, outcome, number, f"{name} #{number}", held)
        for number in range(len(outcome.files))
    ]
    context.view_layer.update()
    sizes = [_size(handle) for handle in handles]
    for handle, (x, y) in zip(handles, grid.places(sizes), strict=True):
        handle.location = (at[0] + x, at[1] + y, at[2])
    context.view_layer.update()
    return run


def show_best(context: bpy.types.Context, best: Mesh, at: Sequence[float]) -> None:
    """Show the best result so far as an object that cannot be selected; the end of the search removes it."""
    hide_best()
    data = bpy.data.meshes.new(BEST)
    data.from_pydata(best.vertices.tolist(), [], best.faces.tolist())
    preview = bpy.data.objects.new(BEST, data)
    preview.location, preview.hide_select, preview.hide_render = at, True, True
    context.scene.collection.objects.link(preview)


def hide_best() -> None:
    """Remove the best result so far."""
    data = bpy.data.meshes.get(BEST)
    if data is not None:
        for preview in [obj for obj in bpy.data.objects if obj.data == data]:
            bpy.data.objects.remove(preview)
        bpy.data.meshes.remove(data)


def handle_of(result: bpy.types.Collection) -> bpy.types.Object | None:
    """Find the empty that moves a result."""
    return next((obj for obj in result.objects if obj.parent is None), None)


def _result(
    context: bpy.types.Context,
    run: bpy.types.Collection,
    outcome: GrowthOutcome,
    number: int,
    name: str,
    held: Collection[str],
) -> bpy.types.Object:
    """Import a result; return the empty that moves it."""
    collection = bpy.data.collections.new(name)
    run.children.link(collection)
    storage.store_result(collection, outcome, number)
    handle = bpy.data.objects.new(name, None)
    collection.objects.link(handle)
    for obj in _import(context, outcome.files[number]):
        for other in list(obj.users_collection):
            other.objects.unlink(obj)
        collection.objects.link(obj)
        if obj.parent is None:
            obj.parent = handle
        if obj.get(storage.ADDRESS) in held:
            obj[storage.HELD] = True
    return handle


def _import(context: bpy.types.Context, file: Path) -> list[bpy.types.Object]:
    """Import the objects of a GLB; equal materials of the .blend are reused."""
    if not addon_utils.check("io_scene_gltf2")[1]:
        addon_utils.enable("io_scene_gltf2")
    if context.object is not None and context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    objects, materials = set(bpy.data.objects), set(bpy.data.materials)
    before = context.scene.get("niwaki")
    bpy.ops.import_scene.gltf(filepath=str(file))
    # The importer stores the choices of calls without an object there; the collection has all choices.
    if before is None and "niwaki" in context.scene:
        del context.scene["niwaki"]
    for material in set(bpy.data.materials) - materials:
        twin = bpy.data.materials.get(material.name.rpartition(".")[0])
        if twin is not None and _look(twin) == _look(material):
            material.user_remap(twin)
            bpy.data.materials.remove(material)
    return [obj for obj in bpy.data.objects if obj not in objects]


def _look(material: bpy.types.Material) -> tuple[float, ...]:
    """Return colour, roughness and metalness of a material."""
    shader = material.node_tree and material.node_tree.nodes.get("Principled BSDF")
    if not shader:
        return (*material.diffuse_color, material.roughness, material.metallic)
    inputs = shader.inputs
    color = inputs["Base Color"].default_value
    return (*color, inputs["Roughness"].default_value, inputs["Metallic"].default_value)


def _size(handle: bpy.types.Object) -> tuple[float, float]:
    """Measure the objects of a handle along x and y."""
    corners = [
        np.array(obj.bound_box) @ np.array(obj.matrix_world)[:2, :3].T + np.array(obj.matrix_world)[:2, 3]
        for obj in handle.children_recursive
        if obj.type == "MESH"
    ]
    if not corners:
        return (0.0, 0.0)
    x, y = np.ptp(np.concatenate(corners), axis=0).tolist()
    return (x, y)
