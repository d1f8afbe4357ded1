"""A scene as a file that the next tool opens: GLB, OBJ, STL or PLY.

GLB keeps the most: a node for each part, named by its address; a material for each colour; smooth normals.
It is written here rather than by a library so that the same scene gives the same bytes (glTF 2.0, section 4
for the container, section 3.6 for buffers). The other formats go through trimesh.

A file appears whole or not at all. Lengths are scene units, y is up, as glTF asks.
"""

from __future__ import annotations

import json
import struct
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.palette import Paint, paints
from niwaki.draw.picture import write_whole
from niwaki.file_errors import FileError

if TYPE_CHECKING:
    from niwaki.scene import Part, Scene

FORMATS = (".glb", ".obj", ".stl", ".ply")

# glTF's names for numbers.
FLOAT, UNSIGNED_INT, ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 5126, 5125, 34962, 34963


def export(scene: Scene, path: str | PathLike[str]) -> Path:
    """Write a scene to a file whose name ends in .glb, .obj, .stl or .ply.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    FileError
        Another ending, an empty scene, or a place that cannot be written to.
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix not in FORMATS:
        raise FileError(
            "file-format",
            place,
            suffix=place.suffix or "no suffix",
            done="written",
            formats=", ".join(FORMATS),
        )
    if len(scene) == 0:
        raise FileError("scene-empty", place, verb="write")
    return write_whole(place, glb(scene) if suffix == ".glb" else _through_trimesh(scene, suffix[1:]))


def glb(scene: Scene) -> bytes:
    """Return the scene as the bytes of a GLB file; equal scenes give equal bytes."""
    buffer = bytearray()
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []
    materials: dict[Paint, int] = {}

    def accessor(array: NDArray[Any], kind: str, component: int, target: int) -> int:
        """Append an array to the buffer and describe it."""
        data = array.tobytes()
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data), "target": target})
        buffer.extend(data)  # all components have four bytes, so offsets stay aligned
        entry = {"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind}
        if kind == "VEC3":
            entry |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        accessors.append(entry)
        return len(accessors) - 1

    meshes = []
    for part, groups in _groups(scene):
        primitives = []
        for paint, vertices, faces, normals in groups:
            attributes = {
                "POSITION": accessor(vertices.astype("<f4"), "VEC3", FLOAT, ARRAY_BUFFER),
                "NORMAL": accessor(normals.astype("<f4"), "VEC3", FLOAT, ARRAY_BUFFER),
            }
            indices = accessor(faces.astype("<u4").reshape(-1), "SCALAR", UNSIGNED_INT, ELEMENT_ARRAY_BUFFER)
            material = materials.setdefault(paint, len(materials))
            primitives.append({"attributes": attributes, "indices": indices, "material": material, "mode": 4})
        meshes.append({"name": part.address, "primitives": primitives})

    document = {
        "asset": {"version": "2.0", "generator": "niwaki"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(meshes)))}],
        "nodes": [{"name": mesh["name"], "mesh": k} for k, mesh in enumerate(meshes)],
        "meshes": meshes,
        "materials": [_material(paint, k) for paint, k in materials.items()],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(buffer)}],
    }
    text = json.dumps(document, separators=(",", ":"), ensure_ascii=True).encode()
    text += b" " * (-len(text) % 4)
    chunks = (
        struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    )
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


Group = tuple[Paint, NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]


def _groups(scene: Scene) -> list[tuple[Part, list[Group]]]:
    """For each part and each paint in it: the merged fine meshes (paint, vertices, faces, normals)."""
    out = []
    for part, part_paints in zip(scene.parts, paints(scene), strict=True):
        groups: dict[Paint, list[tuple[NDArray[Any], NDArray[Any], NDArray[Any]]]] = {}
        for shape, paint in zip(part.shapes, part_paints, strict=True):
            groups.setdefault(paint, []).append(_engine.fine_mesh(shape))
        merged: list[Group] = []
        for paint, meshes in groups.items():
            starts = np.cumsum([0, *(len(vertices) for vertices, _, _ in meshes)])
            faces = [mesh[1] + start for mesh, start in zip(meshes, starts, strict=False)]
            vertices, normals = (np.concatenate([mesh[k] for mesh in meshes]) for k in (0, 2))
            merged.append((paint, vertices, np.concatenate(faces), normals))
        if merged:
            out.append((part, merged))
    return out


def _material(paint: Paint, number: int) -> dict[str, Any]:
    return {
        "name": f"paint {number}",
        "pbrMetallicRoughness": {
            "baseColorFactor": [*(round(_linear(c), 6) for c in paint.color), 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": round(0.9 - 0.55 * paint.gloss, 6),
        },
    }


def _linear(c: float) -> float:
    """From sRGB, as colours are written, to linear, as glTF wants them."""
    c = min(max(c, 0.0), 1.0)
    return c / 12.92 if c <= 0.04045 else float(((c + 0.055) / 1.055) ** 2.4)


def _through_trimesh(scene: Scene, kind: str) -> bytes:
    import trimesh

    world: Any = trimesh.Scene()
    for part, groups in _groups(scene):
        for k, (paint, vertices, faces, normals) in enumerate(groups):
            color = [*(round(255 * c) for c in paint.color), 255]
            mesh = trimesh.Trimesh(
                vertices, faces, vertex_normals=normals, vertex_colors=[color] * len(vertices), process=False
            )
            name = part.address if k == 0 else f"{part.address}#{k}"
            world.add_geometry(mesh, node_name=name, geom_name=name)
    if kind == "obj":
        data = world.export(file_type="obj", include_normals=True, header=None)
    else:
        data = world.to_mesh().export(file_type=kind)
    return data.encode() if isinstance(data, str) else bytes(data)
