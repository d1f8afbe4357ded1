"""Conversion of objects, cameras, lights and images to arrays, in world space and with modifiers."""

from __future__ import annotations

from math import atan2, degrees

import bpy
import numpy as np
from niwaki.fitting.in_blender.stage import triangles_of
from numpy.typing import NDArray

from .order import Eye, Mesh

#: The largest relative difference between equal aspect ratios.
NEAR = 0.01


def mesh(obj: bpy.types.Object, context: bpy.types.Context) -> Mesh:
    """Read the triangles of an object in world space.

    Raises
    ------
    ValueError
        The object has no faces.
    """
    evaluated = obj.evaluated_get(context.evaluated_depsgraph_get())
    points, triangles = triangles_of(evaluated, np.array(evaluated.matrix_world, dtype=np.float64))
    if not len(triangles):
        raise ValueError(f"{obj.name} has no faces")
    return Mesh(obj.name, points, triangles)


def eye(obj: bpy.types.Object, scene: bpy.types.Scene) -> Eye:
    """Read a camera of the scene.

    Raises
    ------
    ValueError
        The camera is panoramic, or its view is shifted.
    """
    lens = obj.data
    if lens.type not in ("PERSP", "ORTHO"):
        raise ValueError(f"{obj.name} is panoramic: choose a perspective or an orthographic camera")
    if lens.shift_x or lens.shift_y:
        raise ValueError(f"The view of {obj.name} is shifted: set both shifts to 0")
    corners = np.array(lens.view_frame(scene=scene))
    half = float(np.ptp(corners[:, 1])) / 2.0
    matrix = np.array(obj.matrix_world, dtype=np.float64)
    axes = matrix[:3, :3] / np.linalg.norm(matrix[:3, :3], axis=0)
    view = {
        "position": tuple(matrix[:3, 3].tolist()),
        "forward": tuple((-axes[:, 2]).tolist()),
        "up": tuple(axes[:, 1].tolist()),
    }
    if lens.type == "ORTHO":
        return Eye(**view, height=2.0 * half)
    fov = degrees(2.0 * atan2(half, -float(corners[0, 2])))
    return Eye(**view, fov=fov, near=lens.clip_start)


def light(obj: bpy.types.Object) -> tuple[float, float, float]:
    """Read the direction of a light, as that of a sun."""
    x, y, z = (-np.array(obj.matrix_world, dtype=np.float64)[:3, 2]).tolist()
    return (x, y, z)


def mask(image: bpy.types.Image) -> NDArray[np.bool_]:
    """Mark the light and opaque pixels of an image, (rows, columns), the upper row first.

    Raises
    ------
    ValueError
        The image has no pixels.
    """
    columns, rows = image.size
    if not columns or not rows:
        raise ValueError(f"The image {image.name} has no pixels")
    pixels = np.empty(columns * rows * image.channels, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(rows, columns, image.channels)[::-1]
    covered = pixels[:, :, 0] > 0.5
    if image.channels == 4:
        covered &= pixels[:, :, 3] > 0.5
    return np.ascontiguousarray(covered)


def check_shape(image: bpy.types.Image, scene: bpy.types.Scene) -> None:
    """Check that an image has the aspect ratio of the render.

    Raises
    ------
    ValueError
        The aspect ratios differ.
    """
    render = scene.render
    columns, rows = image.size
    wide = render.resolution_x * render.pixel_aspect_x
    high = render.resolution_y * render.pixel_aspect_y
    if abs(columns * high / (rows * wide) - 1.0) > NEAR:
        raise ValueError(
            f"{image.name} has {columns} x {rows} pixels, and the render has "
            f"{render.resolution_x} x {render.resolution_y}: set both to the same aspect ratio"
        )
