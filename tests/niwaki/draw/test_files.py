"""Claim: an exported scene opens elsewhere with its parts, names and volume; equal scenes give equal bytes; a
file that cannot be written completely is not written at all."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
import trimesh
from niwaki import _engine
from niwaki.draw.glb import glb
from niwaki.draw.scene import Scene
from niwaki.errors import FileError


def scene(order: int = 1) -> Scene:
    parts = [
        ("ship/body", [_engine.shape("box", (0, 0, 0), (2, 1, 4), bevel=0.0)]),
        (
            "ship/wings",
            [
                _engine.shape("box", (s * 2.0, 0, 0), (2, 0.5, 1), bevel=0.0, color=(0.5, 0.2, 0.1))
                for s in (1, -1)
            ],
        ),
        ("ship/engine", [_engine.shape("cylinder", (0, 0, -3), 0.5, 2.0, "z", bevel=0.0)]),
    ]
    return Scene(parts[::order])


def test_glb_has_a_node_for_each_part(tmp_path: Path) -> None:
    path = scene().export(tmp_path / "ship.glb")
    loaded = trimesh.load_scene(path)
    names = {loaded.graph[name][1] for name in loaded.graph.nodes_geometry}
    assert set(loaded.graph.nodes_geometry) == {"body", "engine", "wings"}
    assert len(names) == 3
    volumes = {name: loaded.geometry[loaded.graph[name][1]].volume for name in loaded.graph.nodes_geometry}
    assert volumes["body"] == pytest.approx(8.0, rel=1e-6)
    assert volumes["wings"] == pytest.approx(2.0, rel=1e-6)
    assert volumes["engine"] == pytest.approx(np.pi / 2, rel=5e-3)
    assert np.allclose(loaded.bounds, scene().bounds, atol=1e-6)


def test_glb_keeps_normals_and_linear_colours() -> None:
    data = glb(scene())
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data))
    size, kind = struct.unpack_from("<I4s", data, 12)
    document = json.loads(data[20 : 20 + size])
    assert kind == b"JSON" and size % 4 == 0
    colors = [m["pbrMetallicRoughness"]["baseColorFactor"] for m in document["materials"]]
    assert any(np.allclose(c, [0.214041, 0.033105, 0.010023, 1.0], atol=1e-5) for c in colors)
    primitive = document["meshes"][0]["primitives"][0]
    view = document["bufferViews"][document["accessors"][primitive["attributes"]["NORMAL"]]["bufferView"]]
    start = 20 + size + 8 + view["byteOffset"]
    normals = np.frombuffer(data, "<f4", view["byteLength"] // 4, start).reshape(-1, 3)
    assert np.allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)


def test_glb_is_the_same_to_the_byte() -> None:
    assert glb(scene()) == glb(scene(-1))


@pytest.mark.parametrize("suffix", ["obj", "ply"])
def test_plain_meshes_open_again(tmp_path: Path, suffix: str) -> None:
    path = scene().export(tmp_path / f"ship.{suffix}")
    again = trimesh.load_mesh(path)
    assert again.volume == pytest.approx(8.0 + 2.0 + np.pi / 2, rel=5e-3)
    assert np.allclose(again.bounds, scene().bounds, atol=1e-6)
    colors = np.asarray(again.visual.vertex_colors)[:, :3]
    assert (colors == [128, 51, 26]).all(axis=1).any()
    first = path.read_bytes()
    assert scene(-1).export(path).read_bytes() == first


def test_an_obj_has_an_object_for_each_part(tmp_path: Path) -> None:
    path = scene().export(tmp_path / "ship.obj")
    again = trimesh.load_scene(path, split_objects=True, group_material=False)
    assert set(again.geometry) == {"ship/body", "ship/engine", "ship/wings"}
    assert again.geometry["ship/body"].volume == pytest.approx(8.0, rel=1e-6)


def test_bad_places_are_refused_and_leave_nothing(tmp_path: Path) -> None:
    for path, subject, code in [
        (tmp_path / "ship.blend", scene(), "file-format"),
        (tmp_path / "ship.glb", Scene([]), "scene-empty"),
        (tmp_path / "no folder" / "ship.glb", scene(), "file-unwritable"),
        (tmp_path / "no folder" / "ship.stl", scene(), "file-unwritable"),
        (tmp_path / "no folder" / "ship.gif", Scene(scene().parts[:1]), "file-unwritable"),
    ]:
        with pytest.raises(FileError) as caught:
            subject.export(path)
        assert caught.value.code == code
    assert list(tmp_path.iterdir()) == []


def test_only_print_formats_are_scaled(tmp_path: Path) -> None:
    for setting in ("scale", "fuse"):
        with pytest.raises(FileError, match=f"`{setting}` cannot be 2.0"):
            scene().export(tmp_path / "ship.glb", **{setting: 2.0})
    assert list(tmp_path.iterdir()) == []


@nw.model
def bell():
    """A block of steel with a rougher block, on a painted block."""
    nw.emit(
        nw.box((0.0, 1.0, 0.0), (1.0, 1.0, 1.0)),
        nw.box((2.0, 1.0, 0.0), (1.0, 1.0, 1.0), roughness=0.75),
        color=(0.5, 0.5, 0.5),
        metalness=1.0,
        roughness=0.25,
    )
    nw.emit(nw.box((0.0, -1.0, 0.0), (1.0, 1.0, 1.0), color=(1.0, 0.0, 0.0)))


def test_materials_have_the_metalness_and_roughness_of_the_model() -> None:
    scene = nw.run(bell, seed=1).best.scene
    data = glb(scene)
    document = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
    finishes = [
        (finish["metallicFactor"], finish["roughnessFactor"])
        for finish in (material["pbrMetallicRoughness"] for material in document["materials"])
    ]
    assert sorted(finishes)[1:] == [(1.0, 0.25), (1.0, 0.75)] and sorted(finishes)[0][0] == 0.0
    plain = nw.run_python(bell, seed=1).scene
    assert [list(shapes) for _, shapes in plain] == [list(part.shapes) for part in scene]


def test_a_metalness_out_of_range_is_refused() -> None:
    with pytest.raises(nw.ModelFault, match="metalness is 2, expected a number from 0 to 1"):
        nw.run(_shiny, 2.0, seed=1)


@nw.model
def _shiny(much: float):
    nw.emit(nw.box((0, 0, 0), (1, 1, 1)), metalness=much)
