"""Claim: a solid cut from others is closed and of its exact volume in every file, in the colours of its solids.

Pictures need no library, and files without it are refused with the name of the extra. Trimesh reads the files.
"""

from __future__ import annotations

import json
import struct
import sys
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
import trimesh
from niwaki import _engine
from niwaki._engine import Shape
from niwaki.draw.closed import closed
from niwaki.draw.glb import glb
from niwaki.draw.palette import paints
from niwaki.draw.parts import coated, part_meshes
from niwaki.draw.picture import picture
from niwaki.draw.scene import Scene
from niwaki.draw.solid import union
from niwaki.errors import FileError

RED, BLUE = (0.8, 0.1, 0.1), (0.1, 0.2, 0.8)


def box(center: Any, size: Any, **look: Any) -> Shape:
    return _engine.shape("box", center, size, **look)


def cylinder(center: Any, radius: float, length: float, **look: Any) -> Shape:
    return _engine.shape("cylinder", center, radius, length, axis="z", **look)


def window(x: float, **look: Any) -> Shape:
    """A window with a round top, 0.6 wide: the rectangle is 0.8 high."""
    return box((x, 0.4, 0), (0.6, 0.8, 1.0), **look) | cylinder((x, 0.8, 0), 0.3, 1.0, **look)


def wall(**look: Any) -> Shape:
    return box((0, 0.75, 0), (3, 2, 0.3)) - window(-0.7, **look) - window(0.7, **look)


#: A half disc of 48 sides in a circle of radius 0.3.
HALF_DISC = 0.3**2 * 24 * np.sin(2 * np.pi / 48) / 2
VOLUME = 0.3 * (3 * 2 - 2 * (0.6 * 0.8 + HALF_DISC))


def solid(parts: list[Any]) -> trimesh.Trimesh:
    """The parts as one mesh, with equal places merged."""
    meshes = [trimesh.Trimesh(part.vertices, part.faces, process=False) for part in parts]
    return trimesh.Trimesh(**trimesh.util.concatenate(meshes).to_dict() | {"process": True})


def test_the_mesh_of_a_cut_is_closed_and_has_its_volume_and_normals() -> None:
    parts = closed(wall(), "wall")
    mesh = solid(parts)
    assert mesh.is_watertight and mesh.is_winding_consistent
    assert mesh.volume == pytest.approx(VOLUME, rel=1e-6)
    assert {part.leaf for part in parts} == {0, 1, 2, 3, 4}
    for part in parts:
        across = np.cross(
            part.vertices[part.faces[:, 1]] - part.vertices[part.faces[:, 0]],
            part.vertices[part.faces[:, 2]] - part.vertices[part.faces[:, 0]],
        )
        assert np.einsum("ij,ij->i", across, part.normals[part.faces[:, 0]]).min() > -1e-9


@pytest.mark.parametrize("sign", ["-", "&", "|"])
def test_the_library_and_the_engine_cut_the_same_solid(sign: str) -> None:
    first, second = box((0, 0, 0), (2, 1.5, 1)), _engine.shape("sphere", (0.6, 0.4, 0.3), 0.8)
    shape = {"-": first - second, "&": first & second, "|": first | second}[sign]
    ((vertices, faces, _, _),) = _engine.meshes([[shape]])
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    pictured = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0
    mesh = solid(closed(shape, "part"))
    assert mesh.is_watertight and mesh.volume == pytest.approx(pictured, rel=1e-6)
    low, high = shape.aabb()
    assert np.allclose(mesh.bounds, [low, high], atol=0.02)


def test_files_of_a_cut_are_read_as_closed_solids(tmp_path: Path) -> None:
    scene = Scene([("wall", [wall()])])
    for suffix in (".glb", ".obj", ".ply"):
        mesh = trimesh.load(scene.export(tmp_path / f"wall{suffix}"), force="mesh")
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
        assert mesh.is_watertight and mesh.volume == pytest.approx(VOLUME, rel=1e-4), suffix
    printed = trimesh.load_mesh(scene.export(tmp_path / "wall.stl", scale=100.0))
    assert printed.is_watertight and printed.volume == pytest.approx(VOLUME * 1e6, rel=1e-3)
    assert union(scene).pieces == 1


def test_a_face_has_the_colour_of_its_solid_or_of_the_first() -> None:
    scene = Scene(
        [("a", [box((0, 0, 0), (2, 2, 0.3), color=RED) - cylinder((0, 0, 0), 0.5, 1.0, color=BLUE)])]
    )
    assert [paint.color for (paint, *_) in [paints(coated(scene))[0]]] == [pytest.approx(RED)]
    data = glb(scene)
    document = json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])
    assert [material["name"] for material in document["materials"]] == ["#cc1a1a", "#1a33cc"]
    assert len(document["meshes"]) == 1 and len(document["meshes"][0]["primitives"]) == 2
    for is_closed in (True, False):
        (part,) = part_meshes(scene, closed=is_closed)
        outside, inside = part.pieces
        radii = np.hypot(*inside.vertices[:, :2].T)
        assert radii.min() > 0.49 and radii.max() < 0.5 + 1e-9
        assert np.abs(outside.vertices[:, :2]).max() == 1.0
    plain = Scene([("a", [box((0, 0, 0), (2, 2, 0.3), color=RED) - cylinder((0, 0, 0), 0.5, 1.0)])])
    assert [piece.paint.name for piece in part_meshes(plain)[0].pieces] == ["#cc1a1a"]


def test_pictures_need_no_library_and_files_name_the_extra(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    scene = Scene([("wall", [wall()])])
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    image = np.asarray(picture(scene, size=(90, 60), samples=4, azimuth=0.0, elevation=0.0, backdrop="clear"))
    column = image[:, 30, 3]
    assert image[30, 45, 3] == 255 and column[45] < 255, "the wall is there, and a window is open"
    for name in ("wall.glb", "wall.obj", "wall.ply", "wall.stl"):
        with pytest.raises(FileError, match=r"niwaki\[print\]"):
            scene.export(tmp_path / name)
    assert not list(tmp_path.iterdir())
    whole = Scene([("wall", [box((0, 0, 0), (1, 1, 1))])])
    assert whole.export(tmp_path / "whole.glb").exists()


def test_an_open_mesh_in_a_cut_is_reported() -> None:
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64)
    opened = _engine.shape("mesh", corners, np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3]]))
    with pytest.raises(FileError, match="a mesh in a cut"):
        closed(box((0, 0, 0), (1, 1, 1)) - opened, "part")


def test_a_cut_is_stored_and_read_again() -> None:
    shape = wall(color=RED)
    again = Shape.of_data(shape.data())
    assert (
        again == shape
        and again.steps() == shape.steps()
        and np.array_equal(again.vertices(), shape.vertices())
    )
    text = shape.data()
    for bad in (text.replace('"difference"', '"solid"', 1), text.replace('"solid",', "", 1)):
        assert bad != text
        with pytest.raises(ValueError, match="steps of a cut|an operation without"):
            Shape.of_data(bad)


@nw.model
def opened(shift: float):
    nw.emit(nw.box((0, 0, 0), (1, 1, 1)) - nw.box((shift, 0, 0), (2, 2, 2)))


@nw.model
def wrong():
    solid = nw.box((0, 0, 0), (1, 1, 1))
    nw.emit(solid - 3)


@nw.model
def flat():
    nw.emit(nw.box((0, 0, 0), (1, 1, 1)) - nw.disc((0, 0, 0), 0.2))


def test_what_cannot_be_cut_is_a_fault_at_the_operator() -> None:
    for run in (
        lambda model, *args: nw.run_python(model, *args, seed=1),
        lambda model, *args: nw.run(model, *args, seed=1),
    ):
        with pytest.raises(nw.ModelFault, match="nothing is left of the solid") as empty:
            run(opened, 0.0)
        assert empty.value.code == "bad-shape" and "some of `a` must be outside" in str(empty.value)
        place = empty.value.stack[-1].span
        assert place is not None and place.line == opened.__code__.co_firstlineno + 2
        assert run(opened, 0.9) is not None
        with pytest.raises(nw.ModelFault) as kinds:
            run(wrong)
        assert kinds.value.code == "type-mismatch"
        with pytest.raises(nw.ModelFault, match="the ellipse is flat, expected a solid"):
            run(flat)
