"""Claim: parts share a mesh exactly if they differ by a scale, a rotation and a translation; a node has the place of
its part, and the nodes above it are the calls of its address."""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from niwaki import _engine, rotation
from niwaki._engine import Shape
from niwaki.draw.glb import glb
from niwaki.draw.hierarchy import DEEPEST, hierarchy
from niwaki.draw.instances import instances, quaternion
from niwaki.draw.parts import part_meshes
from niwaki.draw.scene import Scene

AXIS = (0.36, 0.48, 0.8)


def turned(angle: float) -> Any:
    return rotation(AXIS, angle)


def blocks(count: int = 12) -> Scene:
    """Equal blocks of one colour in many places and rotations."""
    return Scene(
        (
            f"block[{k}]",
            [
                _engine.shape(
                    "box", (3.0 * k, 0.1 * k, 0), (1, 2, 0.5), rotation=turned(0.5 * k), color=(0.5, 0.4, 0.3)
                )
            ],
        )
        for k in range(count)
    )


def document(data: bytes) -> dict[str, Any]:
    size = struct.unpack_from("<I", data, 12)[0]
    return dict(json.loads(data[20 : 20 + size]))


def numbers(*shapes: Shape) -> list[int]:
    """Number the geometry of each shape."""
    scene = Scene((f"{k}", [shape]) for k, shape in enumerate(shapes))
    return [instance.mesh for instance in instances(part_meshes(scene))[1]]


def test_equal_blocks_are_one_mesh_with_a_node_for_each(tmp_path: Path) -> None:
    contents = document(glb(blocks()))
    assert len(contents["nodes"]) == 12 and len(contents["meshes"]) == 1 and len(contents["accessors"]) == 3
    assert [node["name"] for node in contents["nodes"]] == [f"block[{k}]" for k in range(12)]
    assert all(node["extras"]["address"] == node["name"] for node in contents["nodes"])
    loaded = trimesh.load_scene(blocks().export(tmp_path / "blocks.glb"))
    assert len(loaded.graph.nodes_geometry) == 12 and len(loaded.geometry) == 1
    for part in blocks():
        matrix, name = loaded.graph[part.address]
        corners = trimesh.transform_points(loaded.geometry[name].vertices, matrix)
        low, high = part.shapes[0].aabb()
        assert np.allclose(corners.min(axis=0), low, atol=0.1) and np.allclose(
            corners.max(axis=0), high, atol=0.1
        )


def test_each_node_keeps_the_place_of_every_vertex(tmp_path: Path) -> None:
    mixed = Scene(
        [*blocks(4).parts, ("other", [_engine.shape("cylinder", (1, 2, 3), 0.5, 2.0, (1.0, 1.0, 0.0))])]
    )
    loaded = trimesh.load_scene(mixed.export(tmp_path / "mixed.glb"), process=False)
    for part in part_meshes(mixed):
        matrix, name = loaded.graph[part.address]
        corners = trimesh.transform_points(loaded.geometry[name].vertices, matrix)
        assert np.abs(corners - part.pieces[0].vertices).max() < 2e-6


def test_equality_of_parts() -> None:
    box = _engine.shape("box", (0, 0, 0), (1, 2, 3))
    assert numbers(box, _engine.shape("box", (9, -4, 1), (1, 2, 3), rotation=turned(2.2))) == [0, 0]
    assert numbers(box, _engine.shape("box", (0, 0, 0), (1, 2, 3.0001))) == [0, 1]
    assert numbers(box, _engine.shape("cylinder", (0, 0, 0), 0.5, 2.0)) == [0, 1]
    along_x = _engine.shape("cylinder", (0, 0, 0), 0.5, 2.0, "x")
    assert numbers(along_x, _engine.shape("cylinder", (5, 0, 0), 0.5, 2.0, "z")) == [0, 0]
    assert numbers(
        _engine.shape("cylinder", (0, 0, 0), 0.5, 2.0),
        _engine.shape("cylinder", (0, 0, 0), 0.5, 2.0, top_radius=0.4),
    ) == [0, 1]


def test_parts_of_different_sizes_share_a_mesh(tmp_path: Path) -> None:
    sizes = (1.0, 2.5, 1e-3, 7.0)
    scene = Scene(
        (
            f"{k}",
            [
                _engine.shape(
                    "box", (50.0 * k, 1, 2), (s, 2 * s, 3 * s), rotation=turned(k), bevel=0.0, color=(1, 0, 0)
                )
            ],
        )
        for k, s in enumerate(sizes)
    )
    contents = document(glb(scene))
    assert len(contents["meshes"]) == 1
    assert [node.get("scale", [1.0])[0] for node in contents["nodes"]] == pytest.approx(sizes, rel=1e-9)
    loaded = trimesh.load_scene(scene.export(tmp_path / "sizes.glb"), process=False)
    for part, size in zip(part_meshes(scene), sizes, strict=True):
        matrix, name = loaded.graph[part.address]
        corners = trimesh.transform_points(loaded.geometry[name].vertices, matrix)
        assert np.abs(corners - part.pieces[0].vertices).max() < 1e-6 * max(size, 50.0)


ADDRESSES = (
    "emit",
    "body/emit",
    "i[0]/wing/emit",
    "i[1]/wing/emit",
    "i[1]/wing/tip",
    "i[1]/wing/tip#1",
    "mast",
)


def tree(addresses: Sequence[str]) -> list[Any]:
    """List the names of nodes, each with its children."""
    nodes: list[dict[str, Any]] = [
        {"extras": {"address": address}, "translation": [0.0, 0.0, 0.0]} for address in addresses
    ]

    def shown(number: int) -> Any:
        below = nodes[number].get("children")
        name = nodes[number]["name"]
        return name if below is None else [name, *map(shown, below)]

    return [shown(number) for number in hierarchy(nodes)[0]]


def test_nodes_are_in_the_hierarchy_of_calls() -> None:
    assert tree(ADDRESSES) == [
        "emit",
        "mast",
        "body",
        "i[0].wing",
        ["i[1].wing", "wing", "tip", "tip#1"],
    ]
    deep = ["/".join(["grow"] * k + ["emit"]) for k in range(1, 3 * DEEPEST)]

    def depth(nodes: Any) -> int:
        return 1 + max(map(depth, nodes[1:])) if isinstance(nodes, list) else 1

    assert max(map(depth, tree(deep))) <= DEEPEST + 2
    assert "/" not in str(tree(deep))


def test_materials_have_names() -> None:
    orange = _engine.shape("limb", (0, 0, 0), (0, 1, 0), 0.2, 0.1, color=(1.0, 0.5, 0.0))
    bridge = document(
        glb(Scene([("limb", [orange]), ("deck", [_engine.shape("box", (5, 0, 0), (4, 2, 3))])]))
    )
    assert [material["name"] for material in bridge["materials"]] == ["warm grey", "#ff8000"]
    bark = _engine.shape("limb", (9, 0, 0), (9, 1, 0), 0.2, 0.1)
    names = [
        material["name"] for material in document(glb(Scene([("a", [orange]), ("b", [bark])])))["materials"]
    ]
    assert names == ["#ff8000", "bark"]


def test_mirror_images_are_different() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], dtype=np.float64)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    assert numbers(
        _engine.shape("mesh", corners, faces), _engine.shape("mesh", corners * [1, 1, -1], faces)
    ) == [0, 1]


def test_parts_with_different_paints_share_only_the_buffers() -> None:
    red, blue = (
        _engine.shape("box", (k, 0, 0), (1, 1, 1), color=c) for k, c in ((0, (1, 0, 0)), (3, (0, 0, 1)))
    )
    contents = document(glb(Scene([("red", [red]), ("blue", [blue]), ("also red", [red])])))
    assert len(contents["nodes"]) == 3 and len(contents["meshes"]) == 2 and len(contents["accessors"]) == 3
    assert len(contents["materials"]) == 2


def test_palette_tones_make_few_materials() -> None:
    scene = Scene((f"block[{k}]", [_engine.shape("box", (2.0 * k, 0, 0), (1, 1, 1))]) for k in range(300))
    contents = document(glb(scene))
    assert len(contents["nodes"]) == 300 and len(contents["accessors"]) == 3
    assert len(contents["meshes"]) == len(contents["materials"]) < 60


@pytest.mark.parametrize("seed", range(20))
def test_quaternions_equal_the_rotation(seed: int) -> None:
    draw = np.random.default_rng(seed)
    axis = draw.normal(size=3)
    # The naive formula divides by zero at half turns.
    angle = np.pi if seed < 8 else draw.uniform(-np.pi, np.pi)
    matrix = np.array(rotation(tuple(axis / np.linalg.norm(axis)), angle))
    x, y, z, w = quaternion(matrix)
    assert np.allclose(trimesh.transformations.quaternion_matrix([w, x, y, z])[:3, :3], matrix, atol=1e-12)
