"""Claim: parts share a mesh exactly when a scale, a rotation and a translation take one onto the other; a node's place
is that of its part, and the nodes above it are the calls of its address."""

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
    """Equal blocks in many places and turns, all of one colour."""
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
    """The geometry of each shape."""
    scene = Scene((f"{k}", [shape]) for k, shape in enumerate(shapes))
    return [instance.mesh for instance in instances(part_meshes(scene))[1]]


def test_equal_blocks_are_one_mesh_with_a_node_for_each(tmp_path: Path) -> None:
    found = document(glb(blocks()))
    assert len(found["nodes"]) == 12 and len(found["meshes"]) == 1 and len(found["accessors"]) == 3
    assert [node["name"] for node in found["nodes"]] == [f"block[{k}]" for k in range(12)]
    assert all(node["extras"]["address"] == node["name"] for node in found["nodes"])
    loaded = trimesh.load_scene(blocks().export(tmp_path / "blocks.glb"))
    assert len(loaded.graph.nodes_geometry) == 12 and len(loaded.geometry) == 1
    for part in blocks():
        matrix, name = loaded.graph[part.address]
        corners = trimesh.transform_points(loaded.geometry[name].vertices, matrix)
        low, high = part.shapes[0].aabb()
        assert np.allclose(corners.min(axis=0), low, atol=0.1) and np.allclose(
            corners.max(axis=0), high, atol=0.1
        )


def test_each_node_puts_every_vertex_where_the_scene_has_it(tmp_path: Path) -> None:
    mixed = Scene(
        [*blocks(4).parts, ("other", [_engine.shape("cylinder", (1, 2, 3), 0.5, 2.0, (1.0, 1.0, 0.0))])]
    )
    loaded = trimesh.load_scene(mixed.export(tmp_path / "mixed.glb"), process=False)
    for part in part_meshes(mixed):
        matrix, name = loaded.graph[part.address]
        corners = trimesh.transform_points(loaded.geometry[name].vertices, matrix)
        assert np.abs(corners - part.pieces[0].vertices).max() < 2e-6


def test_what_is_equal_and_what_is_not() -> None:
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


def test_a_part_and_a_larger_one_share_a_mesh(tmp_path: Path) -> None:
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
    found = document(glb(scene))
    assert len(found["meshes"]) == 1
    assert [node.get("scale", [1.0])[0] for node in found["nodes"]] == pytest.approx(sizes, rel=1e-9)
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
    """The names of nodes, each with those below it."""
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

    def depth(found: Any) -> int:
        return 1 + max(map(depth, found[1:])) if isinstance(found, list) else 1

    assert max(map(depth, tree(deep))) <= DEEPEST + 2
    assert "/" not in str(tree(deep))


def test_materials_have_names() -> None:
    own = _engine.shape("limb", (0, 0, 0), (0, 1, 0), 0.2, 0.1, color=(1.0, 0.5, 0.0))
    bridge = document(glb(Scene([("limb", [own]), ("deck", [_engine.shape("box", (5, 0, 0), (4, 2, 3))])])))
    assert [one["name"] for one in bridge["materials"]] == ["warm grey", "#ff8000"]
    bark = _engine.shape("limb", (9, 0, 0), (9, 1, 0), 0.2, 0.1)
    names = [one["name"] for one in document(glb(Scene([("a", [own]), ("b", [bark])])))["materials"]]
    assert names == ["#ff8000", "bark"]


def test_mirror_images_are_different() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], dtype=np.float64)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    assert numbers(
        _engine.shape("mesh", corners, faces), _engine.shape("mesh", corners * [1, 1, -1], faces)
    ) == [0, 1]


def test_other_paints_share_the_buffers_and_not_the_mesh() -> None:
    red, blue = (
        _engine.shape("box", (k, 0, 0), (1, 1, 1), color=c) for k, c in ((0, (1, 0, 0)), (3, (0, 0, 1)))
    )
    found = document(glb(Scene([("red", [red]), ("blue", [blue]), ("also red", [red])])))
    assert len(found["nodes"]) == 3 and len(found["meshes"]) == 2 and len(found["accessors"]) == 3
    assert len(found["materials"]) == 2


def test_palette_tones_make_few_materials() -> None:
    scene = Scene((f"block[{k}]", [_engine.shape("box", (2.0 * k, 0, 0), (1, 1, 1))]) for k in range(300))
    found = document(glb(scene))
    assert len(found["nodes"]) == 300 and len(found["accessors"]) == 3
    assert len(found["meshes"]) == len(found["materials"]) < 60


@pytest.mark.parametrize("seed", range(20))
def test_quaternions_are_the_rotation(seed: int) -> None:
    draw = np.random.default_rng(seed)
    axis = draw.normal(size=3)
    # Half turns are where the naive formula divides by zero.
    angle = np.pi if seed < 8 else draw.uniform(-np.pi, np.pi)
    matrix = np.array(rotation(tuple(axis / np.linalg.norm(axis)), angle))
    x, y, z, w = quaternion(matrix)
    assert np.allclose(trimesh.transformations.quaternion_matrix([w, x, y, z])[:3, :3], matrix, atol=1e-12)
