"""Claim: Blender reads the files of the corpus of meshes (tests/niwaki/targets/mesh_corpus.py) as Niwaki does, and each
solid that Niwaki writes (benches/solid_files.py) is closed in Blender and has its volume.

`make test-blender` runs this file on the Python that has `bpy`. Files that Niwaki refuses are not compared, because
Blender's importers skip unreadable contents.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

sys.path.append(str(Path(__file__).parents[2] / "niwaki/targets"))
from mesh_corpus import CASES, Case  # noqa: E402

#: Files that Blender reads differently, and the difference.
OTHERWISE = {
    "obj: mark of UTF-8": "reads no first line",
    "obj: UTF-16": "reads no line",
    "obj: lines of old Macs": "reads no line",
    "obj: a path with a backslash": "joins the lines",
    "obj: faces before vertices": "wants vertices first",
    "ply: lines of old Macs": "reads no head",
    "ply: mark of UTF-8": "reads no head",
    "ply: empty lines": "counts empty lines",
    "ply: all in one line": "wants lines",
    "ply: strips in two lists": "wants one list",
    "ply: a list in vertices": "leaves it out",
    "stl: lines of old Macs": "reads no line",
    "stl: capitals": "reads small letters only",
    "stl: binary with 6 bytes behind": "wants the exact length",
    "stl: binary with words behind": "wants the exact length",
}


def read(path: Path) -> None:
    """Import a file without conversion of axes."""
    axes: dict[str, Any] = {"forward_axis": "Y", "up_axis": "Z"}
    if path.suffix in (".glb", ".gltf"):
        bpy.ops.import_scene.gltf(filepath=str(path))
    else:
        getattr(bpy.ops.wm, f"{path.suffix[1:]}_import")(filepath=str(path), **axes)


def triangles() -> np.ndarray:
    """Collect the visible triangles of all objects, (n, 3, 3)."""
    graph = bpy.context.evaluated_depsgraph_get()
    blocks = [np.empty((0, 3, 3))]
    for instance in graph.object_instances:
        if instance.object.type != "MESH":
            continue
        mesh = instance.object.to_mesh()
        mesh.calc_loop_triangles()
        points = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", points)
        corners = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", corners)
        matrix = np.array(instance.matrix_world)
        placed = points.reshape(-1, 3).astype(float) @ matrix[:3, :3].T + matrix[:3, 3]
        faces = corners.reshape(-1, 3)
        # A mirror image reverses its triangles.
        blocks.append(placed[faces if np.linalg.det(matrix[:3, :3]) > 0 else faces[:, ::-1]])
    return np.concatenate(blocks)


@pytest.mark.parametrize(
    "case",
    [case for case in CASES if not case.refused and case.name not in OTHERWISE],
    ids=lambda case: case.slug,
)
def test_blender_gives_the_same_answer(case: Case, tmp_path: Path) -> None:
    bpy.ops.wm.read_homefile(use_empty=True)
    for name, data in (*case.beside, (f"case{case.suffix}", case.data)):
        (tmp_path / name).write_bytes(data)
    read(tmp_path / f"case{case.suffix}")
    corners = triangles()
    if case.suffix in (".glb", ".gltf"):
        # Blender has z up.
        corners = np.stack([corners[..., 0], corners[..., 2], -corners[..., 1]], axis=-1)
    assert case.agrees(corners)


def test_each_solid_is_closed_and_has_its_volume() -> None:
    import bmesh  # `bpy` makes it importable

    folder = Path(os.environ["NIWAKI_SOLIDS"])
    volumes = json.loads((folder / "volumes.json").read_text())
    assert len(volumes) > 20
    for name, volume in volumes.items():
        bpy.ops.wm.read_homefile(use_empty=True)
        read(folder / f"{name}.glb")
        points, numbers = np.unique(triangles().reshape(-1, 3), axis=0, return_inverse=True)
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(points.tolist(), [], numbers.reshape(-1, 3).tolist())
        solid = bmesh.new()
        solid.from_mesh(mesh)
        assert all(edge.is_manifold and edge.is_contiguous for edge in solid.edges), name
        assert abs(solid.calc_volume(signed=True) / volume - 1) < 1e-4, name
        solid.free()
