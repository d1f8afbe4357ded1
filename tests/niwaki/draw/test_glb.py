"""Claim: in a GLB each part turns about its own frame and a call about its first part; each choice of the run is an
extra of exactly one node, that of its call. So the file needs no corrections in other programs."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
import trimesh
from niwaki import _engine, gallery, rotation
from niwaki._engine import Shape
from niwaki.draw.glb import About, glb
from niwaki.draw.parts import Pivot, part_meshes
from niwaki.draw.scene import Scene

TURN = rotation((0.36, 0.48, 0.8), 0.9)
UP = (0.0, 0.6, 0.8)


def pivot(shape: Shape) -> Pivot:
    return part_meshes(Scene([("one", [shape])]))[0].pivot


def document(data: bytes) -> dict[str, Any]:
    size = struct.unpack_from("<I", data, 12)[0]
    return dict(json.loads(data[20 : 20 + size]))


def world(contents: dict[str, Any]) -> dict[str, np.ndarray]:
    """Compute the matrix of each node in the scene, by its address or its name."""
    matrices: dict[str, np.ndarray] = {}

    def walk(number: int, around: np.ndarray) -> None:
        node = contents["nodes"][number]
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        local = trimesh.transformations.quaternion_matrix([w, x, y, z])
        local[:3, :3] *= np.array(node.get("scale", (1, 1, 1)))
        local[:3, 3] = node["translation"]
        matrices[node.get("extras", {}).get("address", node["name"])] = around @ local
        for child in node.get("children", ()):
            walk(child, around @ local)

    for root in contents["scenes"][0]["nodes"]:
        walk(root, np.eye(4))
    return matrices


@pytest.mark.parametrize(
    ("shape", "origin", "axis", "along"),
    [
        (_engine.shape("box", (1, 2, 3), (1, 2, 4), rotation=TURN), (1, 2, 3), 0, np.array(TURN)[:, 0]),
        (_engine.shape("cylinder", (1, 2, 3), 0.5, 2, UP), (1, 2, 3), 1, UP),
        (_engine.shape("limb", (1, 2, 3), (1, 2.6, 3.8), 0.2, 0.1), (1, 2, 3), 1, UP),
        (_engine.shape("limb", (1, 2, 3), (1, 1, 3), 0.2, 0.1), (1, 2, 3), 1, (0, -1, 0)),
        (_engine.shape("stroke", (1, 2, 0), (1, 5, 0), 0.1), (1, 2, 0), 0, (0, 1, 0)),
        (_engine.shape("disc", (1, 2, 0), 2.0), (1, 2, 0), 2, (0, 0, 1)),
    ],
)
def test_a_shape_turns_about_its_own_frame(shape: Shape, origin: Any, axis: int, along: Any) -> None:
    frame = pivot(shape)
    assert frame.origin == pytest.approx(origin)
    assert frame.axes[:, axis] == pytest.approx(np.array(along))
    assert frame.axes.T @ frame.axes == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(frame.axes) == pytest.approx(1.0)


@pytest.mark.parametrize("name", ["spaceship", "gnarly-tree", "building"])
def test_nodes_have_the_frames_of_their_parts_and_the_scene_stays_in_place(name: str, tmp_path: Path) -> None:
    entry = gallery.entry(name)
    assert entry is not None
    sample = nw.run(entry.model, seed=3).best
    path = sample.export(tmp_path / "best.glb")
    matrices = world(document(path.read_bytes()))
    for part in sample.scene.parts:
        frame, matrix = pivot(part.shapes[0]), matrices[part.address]
        assert matrix[:3, 3] == pytest.approx(frame.origin, abs=1e-6)
        # Shapes that differ by a rotation share a mesh; their frames follow the rotation.
        size = np.linalg.norm(matrix[:3, 0])
        assert matrix[:3, :3] / size == pytest.approx(frame.axes, abs=1e-5)
    loaded = trimesh.load_scene(path, process=False)
    reach = np.abs(loaded.bounds).max()
    corners = np.concatenate([piece.vertices for part in part_meshes(sample.scene) for piece in part.pieces])
    assert loaded.bounds == pytest.approx(
        np.stack([corners.min(axis=0), corners.max(axis=0)]), abs=1e-6 * reach
    )


def test_a_call_has_the_place_of_its_first_part() -> None:
    def limb(x: float) -> list[Shape]:
        return [_engine.shape("limb", (x, 1, 2), (x, 2, 2), 0.2, 0.1)]

    scene = Scene([("arm/emit", limb(5)), ("arm/hand/emit", limb(6)), ("arm/hand/thumb/emit", limb(7))])
    contents = document(glb(scene))
    matrices = world(contents)
    assert matrices["arm"][:3, 3] == pytest.approx([5, 1, 2])
    assert matrices["hand"][:3, 3] == pytest.approx([6, 1, 2])
    assert matrices["arm/hand/thumb/emit"][:3, 3] == pytest.approx([7, 1, 2])
    # Nodes below a call have places relative to the call.
    hand = next(node for node in contents["nodes"] if node["name"] == "hand" and "children" in node)
    assert hand["translation"] == pytest.approx([1, 0, 0])


def test_each_choice_is_an_extra_of_its_call() -> None:
    box = [_engine.shape("box", (0, 0, 0), (1, 1, 1))]
    scene = Scene([("wing[0]/emit", box), ("wing[0]/tip/emit", box), ("body/hull/emit", box)])
    choices = {
        "count": 3,
        "wing[0]/length": 1.5,
        "wing[0]/tip/bend": (0.5, float("inf")),
        "wing[0]/tip/flap/angle": True,
        "body/size": "large",
        "body/hull/plates": 7,
        "nothing/here": 0.25,
    }
    contents = document(glb(scene, About("ship", choices)))
    noted = {
        node["extras"].get("address", node["name"]): [row["address"] for row in node["extras"]["choices"]]
        for node in contents["nodes"]
        if "choices" in node.get("extras", {})
    }
    assert noted == {
        "wing[0]": ["wing[0]/length"],
        "wing[0]/tip/emit": ["wing[0]/tip/bend", "wing[0]/tip/flap/angle"],
        "body/hull/emit": ["body/size", "body/hull/plates"],
    }
    extras = contents["scenes"][0]["extras"]["niwaki"]
    assert extras["model"] == "ship" and [row["address"] for row in extras["choices"]] == [
        "count",
        "nothing/here",
    ]
    tip = next(
        node for node in contents["nodes"] if node.get("extras", {}).get("address") == "wing[0]/tip/emit"
    )
    assert [row["value"] for row in tip["extras"]["choices"]] == [[0.5, "inf"], True]


def test_a_sample_s_file_has_all_its_choices(tmp_path: Path) -> None:
    entry = gallery.entry("spaceship")
    assert entry is not None
    sample = nw.run(entry.model, seed=3).best
    contents = document(sample.export(tmp_path / "best.glb").read_bytes())
    holders = [
        *(node.get("extras", {}) for node in contents["nodes"]),
        contents["scenes"][0]["extras"]["niwaki"],
    ]
    noted = [row for holder in holders for row in holder.get("choices", [])]
    assert len({row["address"] for row in noted}) == len(noted)
    assert {row["address"]: row["value"] for row in noted} == {
        address: list(value) if isinstance(value, tuple) else value
        for address, value in sample.held().items()
    }
