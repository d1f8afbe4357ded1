"""The mesh of an object for other values of the sockets of its modifier.

The object stands alone in a scene, so that nothing else is evaluated. What it refers to comes along.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Arrays = tuple[NDArray[np.float64], NDArray[np.int64]]

#: Blender's types of objects that can have faces.
FACED = ("MESH", "CURVE", "SURFACE", "FONT", "META")

#: What an object can give beside a mesh, by Blender's types, with the nodes that make a mesh of it.
WITHOUT_FACES = {
    "POINTCLOUD": ("points", "Instance on Points"),
    "CURVE": ("curves", "Curve to Mesh"),
    "CURVES": ("curves", "Curve to Mesh"),
    "VOLUME": ("a volume", "Volume to Mesh"),
    "GREASEPENCIL": ("Grease Pencil", "Grease Pencil to Curves"),
}


class NoMeshError(ValueError):
    """An object gives points, curves or a volume, and no mesh."""


def stage(data: Any, obj: Any, name: str) -> Any:
    """Return a new scene that has one object alone."""
    scene = data.scenes.new(name)
    scene.collection.objects.link(obj)
    obj.hide_viewport = False
    return scene


def mesh(scene: Any, obj: Any) -> Arrays:
    """Return the mesh of an object as a scene shows it, with its instances: vertices (n, 3) in world space, triangles.

    Raises
    ------
    NoMeshError
        There are points, curves or volumes, and no triangle.
    """
    layer = scene.view_layers[0]
    layer.update()
    parts, kinds = [], set()
    for instance in layer.depsgraph.object_instances:
        source = instance.parent if instance.is_instance else instance.object
        if source is None or source.original != obj:
            continue
        if instance.object.type in FACED:
            part = triangles_of(instance.object, np.array(instance.matrix_world, dtype=np.float64))
            if len(part[1]):
                parts.append(part)
                continue
        kinds.add(instance.object.type)
    if not parts:
        for kind, (word, node) in WITHOUT_FACES.items():
            if kind in kinds:
                raise NoMeshError(f"the modifier gives {word} and no mesh: end it with a node such as {node}")
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    starts = np.cumsum([0, *(len(points) for points, _ in parts)])
    faces = [corners + start for (_, corners), start in zip(parts, starts, strict=False)]
    return np.concatenate([points for points, _ in parts]), np.concatenate(faces)


def triangles_of(evaluated: Any, matrix: NDArray[np.float64]) -> Arrays:
    """Read the triangles of an evaluated object, placed by a matrix."""
    data = evaluated.to_mesh()
    if data is None:
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    try:
        data.calc_loop_triangles()
        vertices = np.empty(3 * len(data.vertices), dtype=np.float32)
        data.vertices.foreach_get("co", vertices)
        faces = np.empty(3 * len(data.loop_triangles), dtype=np.int32)
        data.loop_triangles.foreach_get("vertices", faces)
    finally:
        evaluated.to_mesh_clear()
    points = vertices.reshape(-1, 3).astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    triangles = faces.reshape(-1, 3).astype(np.int64)
    if np.linalg.det(matrix[:3, :3]) < 0.0:
        # A mirror image reverses triangles.
        triangles = triangles[:, ::-1]
    return points, np.ascontiguousarray(triangles)
