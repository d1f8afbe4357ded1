"""A scene as a GLB file: nodes in the hierarchy of the model's calls; equal parts share a mesh.

Niwaki writes the file itself rather than by a library, so that equal scenes give equal bytes (glTF 2.0, section 4 for
the container, 3.6 for buffers, 3.5.3 for nodes). The node of a part has its address as an extra, and each choice of the
run is an extra of the node of its call. Parts of equal geometry (`niwaki.draw.instances`) share buffers. Parts with
equal paints as well share the whole mesh, so that a modelling program opens them as linked copies.

Lengths are metres and y is up, as glTF requires. The node of a part has the frame of its first shape
(`niwaki.draw.parts.Pivot`). The node of a call is at the place of its first part, with the scene's axes. A scene far
from the origin (`niwaki.draw.far`) is below an additional node, `origin`, with the offset.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.draw.assembly import Assembly
from niwaki.draw.far import is_far
from niwaki.draw.finite import plain
from niwaki.draw.hierarchy import hierarchy
from niwaki.draw.instances import Geometry, Instance, instances, quaternion
from niwaki.draw.palette import Paint, material_names
from niwaki.draw.parts import part_meshes

# Constants of glTF.
FLOAT, UNSIGNED_INT, ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER, TRIANGLES = 5126, 5125, 34962, 34963, 4


class _Buffer:
    """The binary data of a file, with views and accessors."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, array: NDArray[Any], kind: str, component: int, target: int) -> int:
        """Append an array and return the number of its accessor."""
        data = array.tobytes()
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), "target": target}
        self.views.append(view)
        self.data.extend(data)  # every component has four bytes, so offsets stay aligned
        entry = {
            "bufferView": len(self.views) - 1,
            "componentType": component,
            "count": len(array),
            "type": kind,
        }
        if kind == "VEC3":
            entry |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        self.accessors.append(entry)
        return len(self.accessors) - 1


@dataclass(frozen=True)
class About:
    """The origin of a scene, for the extras of a file: its model and choices.

    Attributes
    ----------
    model
        The model's name.
    choices
        Values of choices by address.
    """

    model: str
    choices: Mapping[str, Any]


def glb(scene: Assembly, about: About | None = None) -> bytes:
    """Write the scene as the bytes of a GLB file; equal scenes with equal choices give equal bytes."""
    parts = part_meshes(scene)
    geometries, placed = instances(parts)
    buffer = _Buffer()
    primitives_of = [_store(geometry, buffer) for geometry in geometries]
    materials: dict[Paint, int] = {}
    meshes: dict[tuple[int, tuple[Paint, ...]], int] = {}
    mesh_entries: list[dict[str, Any]] = []
    nodes = []
    for part, instance in zip(parts, placed, strict=True):
        paints = tuple(piece.paint for piece in part.pieces)
        if (instance.mesh, paints) not in meshes:
            meshes[instance.mesh, paints] = len(mesh_entries)
            primitives = [
                {**shared, "material": materials.setdefault(paint, len(materials)), "mode": TRIANGLES}
                for shared, paint in zip(primitives_of[instance.mesh], paints, strict=True)
            ]
            mesh_entries.append({"name": "", "primitives": primitives})
        nodes.append(_node(part.address, meshes[instance.mesh, paints], instance))
    choices = [] if about is None else [(address, plain(value)) for address, value in about.choices.items()]
    roots, unplaced = hierarchy(nodes, choices)
    if is_far(scene.bounds):
        roots = [_below_origin(nodes, roots, scene)]
    listed = [{"address": address, "value": value} for address, value in unplaced]
    extras = {} if about is None else {"extras": {"niwaki": {"model": about.model, "choices": listed}}}
    for node in nodes[: len(parts)]:
        mesh_entries[node["mesh"]]["name"] = mesh_entries[node["mesh"]]["name"] or node["name"]
    names = material_names(materials)
    return _container(
        {
            "asset": {"version": "2.0", "generator": "niwaki"},
            "scene": 0,
            "scenes": [{"nodes": roots, **extras}],
            "nodes": nodes,
            "meshes": mesh_entries,
            "materials": [_material(paint, name) for paint, name in zip(materials, names, strict=True)],
            "accessors": buffer.accessors,
            "bufferViews": buffer.views,
            "buffers": [{"byteLength": len(buffer.data)}],
        },
        bytes(buffer.data),
    )


def _store(geometry: Geometry, buffer: _Buffer) -> list[dict[str, Any]]:
    """Add a geometry to the buffer; return attributes and indices for each piece."""
    primitives = []
    for piece in geometry.part.pieces:
        local, normals = geometry.local(piece.vertices), geometry.local_directions(piece.normals)
        attributes = {
            "POSITION": buffer.add(local.astype("<f4"), "VEC3", FLOAT, ARRAY_BUFFER),
            "NORMAL": buffer.add(normals.astype("<f4"), "VEC3", FLOAT, ARRAY_BUFFER),
        }
        corners = piece.faces.astype("<u4").reshape(-1)
        indices = buffer.add(corners, "SCALAR", UNSIGNED_INT, ELEMENT_ARRAY_BUFFER)
        primitives.append({"attributes": attributes, "indices": indices})
    return primitives


def _node(address: str, mesh: int, instance: Instance) -> dict[str, Any]:
    node: dict[str, Any] = {"name": address, "mesh": mesh, "extras": {"address": address}}
    node["translation"] = instance.translation.tolist()
    if instance.scale != 1.0:
        node["scale"] = [instance.scale] * 3
    if not np.allclose(instance.rotation, np.eye(3), rtol=0.0, atol=1e-9):
        node["rotation"] = list(quaternion(instance.rotation))
    return node


def _below_origin(nodes: list[dict[str, Any]], roots: list[int], scene: Assembly) -> int:
    """Move the topmost nodes below a new node with the offset of the scene; return its number."""
    # The offset has 32 bits, so that programs with such numbers lose no digits.
    offset = scene.bounds.mean(axis=0).astype(np.float32).astype(np.float64)
    for root in roots:
        nodes[root]["translation"] = (nodes[root]["translation"] - offset).tolist()
    nodes.append({"name": "origin", "translation": offset.tolist(), "children": roots})
    return len(nodes) - 1


def _material(paint: Paint, name: str) -> dict[str, Any]:
    return {
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*(round(_linear(c), 6) for c in paint.color), 1.0],
            "metallicFactor": round(paint.metalness, 6),
            "roughnessFactor": round(paint.roughness, 6),
        },
    }


def _linear(c: float) -> float:
    """Convert sRGB, the space of colours in Niwaki, to linear colour, the space of glTF."""
    c = min(max(c, 0.0), 1.0)
    return c / 12.92 if c <= 0.04045 else float(((c + 0.055) / 1.055) ** 2.4)


def _container(document: dict[str, Any], data: bytes) -> bytes:
    """Write the two chunks of a GLB file."""
    text = json.dumps(document, separators=(",", ":"), ensure_ascii=True).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
