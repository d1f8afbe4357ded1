"""Pictures of the manual, rendered by Cycles."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np


def material(name: str, color: tuple[float, float, float]) -> bpy.types.Material:
    """Make a material of one colour."""
    paint = bpy.data.materials.new(name)
    paint.use_nodes = True
    paint.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (*color, 1)
    return paint


def render(
    place: Path, cloud: np.ndarray, size: tuple[int, int], tilt: float = 0.85, colors: int = 128
) -> None:
    """Render the scene on the ground, so that all points are in view, with few colours.

    The size is that of the file; the tilt is the angle of the camera from above.
    """
    # Only pictures need Pillow.
    from PIL import Image

    scene, (low, high) = bpy.context.scene, (cloud.min(axis=0), cloud.max(axis=0))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    bpy.ops.mesh.primitive_plane_add(size=400.0, location=((low + high)[0] / 2, (low + high)[1] / 2, low[2]))
    bpy.context.object.data.materials.append(material("ground", (0.42, 0.42, 0.4)))
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle, sun.rotation_euler = 4.0, 0.05, (0.9, 0.0, -0.5)
    scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.75, 0.8, 0.9, 1)
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.3
    camera.rotation_euler = (tilt, 0.0, 0.6)
    bpy.context.view_layer.update()
    flat = [value for point in cloud for value in point]
    camera.location, _ = camera.camera_fit_coords(bpy.context.evaluated_depsgraph_get(), flat)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 16, True
    scene.render.resolution_x, scene.render.resolution_y = (round(side * 11 / 9) for side in size)
    scene.view_settings.view_transform = "AgX"
    scene.render.filepath = str(place)
    bpy.ops.render.render(write_still=True)
    with Image.open(place) as picture:
        small = picture.convert("RGB").resize(size, Image.Resampling.LANCZOS)
    small = small.quantize(colors, dither=Image.Dither.NONE)
    small.save(place, optimize=True)
