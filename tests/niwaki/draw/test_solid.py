"""Claim: a printed solid is the closed union of the shapes, in millimetres with z up; parts that are no solids are
reported by address. Independent libraries read the files: trimesh (STL) and lib3mf (3MF)."""

from __future__ import annotations

import sys
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from niwaki import _engine, rotation
from niwaki._engine import Shape
from niwaki.draw.scene import Scene
from niwaki.draw.solid import PrintWarning, Solid, union
from niwaki.errors import FileError

TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=np.float64)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])


def box(x: float, y: float, z: float, size: tuple[float, float, float] = (2, 2, 2)) -> Shape:
    return _engine.shape("box", (x, y, z), size, bevel=0.0)


def overlapping() -> Scene:
    """Two cubes of side 2 that share a cube of side 1: volume 8 + 8 - 1, 3 wide along each axis."""
    return Scene([("a", [box(0, 0, 0)]), ("b", [box(1, 1, 1)])])


def tower() -> Scene:
    """A box of 4 x 1 x 2 with a box of 1 x 3 x 1 on top; the boxes only touch, and y is up."""
    return Scene([("foot", [box(0, 0.5, 0, (4, 1, 2))]), ("mast", [box(1.5, 2.5, 0.5, (1, 3, 1))])])


def read_stl(path: Path) -> trimesh.Trimesh:
    mesh = trimesh.load_mesh(path)
    assert isinstance(mesh, trimesh.Trimesh)
    return mesh


def read_3mf(path: Path) -> tuple[Any, Any]:
    """Read the model and its first mesh with the consortium's reader in strict mode."""
    from lib3mf import get_wrapper

    model = get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    assert reader.GetWarningCount() == 0
    meshes = model.GetMeshObjects()
    assert meshes.MoveNext()
    return model, meshes.GetCurrentMeshObject()


def corners(mesh: Any) -> np.ndarray:
    return np.array([list(vertex.Coordinates) for vertex in mesh.GetVertices()])


def volume(vertices: np.ndarray, faces: np.ndarray) -> float:
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


def test_an_stl_is_the_union_in_millimetres(tmp_path: Path) -> None:
    solid = read_stl(overlapping().export(tmp_path / "cubes.stl", scale=10.0))
    assert solid.is_watertight and solid.is_winding_consistent
    assert solid.volume == pytest.approx(15_000.0, rel=1e-3)
    assert np.allclose(solid.bounds, [[0, 0, 0], [30, 30, 30]], atol=0.01)


def test_a_scene_is_in_metres_by_default(tmp_path: Path) -> None:
    solid = read_stl(overlapping().export(tmp_path / "cubes.stl"))
    assert np.allclose(solid.extents, 3000.0, rtol=1e-4)


def test_up_on_the_screen_is_up_on_the_bed(tmp_path: Path) -> None:
    solid = read_stl(tower().export(tmp_path / "tower.stl", scale=1.0))
    assert np.allclose(solid.extents, [4, 2, 4], atol=1e-3)
    # The mast stands at x from 1 to 2 and z from 0 to 1 of the scene; a mirrored file would move it.
    high = solid.vertices[solid.vertices[:, 2] > 2.0]
    assert np.allclose([high.min(axis=0)[:2], high.max(axis=0)[:2]], [[3, 0], [4, 1]], atol=1e-3)


def test_a_3mf_has_its_unit_and_name_and_is_closed(tmp_path: Path) -> None:
    from lib3mf import ModelUnit

    model, mesh = read_3mf(tower().export(tmp_path / "a <tower>.3mf", scale=10.0))
    assert model.GetUnit() == ModelUnit.MilliMeter
    assert mesh.GetName() == "a <tower>"
    assert mesh.IsValid() and mesh.IsManifoldAndOriented()
    points = corners(mesh)
    faces = np.array([list(triangle.Indices) for triangle in mesh.GetTriangleIndices()])
    assert volume(points, faces) == pytest.approx(11_000.0, rel=1e-3)
    assert np.allclose([points.min(axis=0), points.max(axis=0)], [[0, 0, 0], [40, 20, 40]], atol=0.01)
    assert model.GetBuildItems().Count() == 1


def test_touching_parts_are_joined_and_separate_parts_reported() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert union(tower()).pieces == 1
    apart = Scene([("a", [box(0, 0, 0)]), ("b", [box(2.1, 0, 0)])])
    with pytest.warns(PrintWarning, match="2 pieces"):
        assert union(apart).pieces == 2
    assert union(apart, fuse=0.1).pieces == 1


def test_a_hollow_is_no_piece() -> None:
    walls = [box(2.0 * s, 0, 0, (1, 5, 5)) for s in (1, -1)]
    walls += [box(0, 2.0 * s, 0, (5, 1, 5)) for s in (1, -1)] + [
        box(0, 0, 2.0 * s, (5, 5, 1)) for s in (1, -1)
    ]
    solid = union(Scene([("room", walls)]), scale=1.0)
    assert solid.pieces == 1
    assert solid.volume == pytest.approx(125.0 - 27.0, rel=1e-3)


@pytest.mark.parametrize("angle", np.linspace(0.1, 3.0, 7))
def test_parts_that_touch_in_any_turn_make_one_closed_solid(angle: float, tmp_path: Path) -> None:
    turn = rotation((0.36, 0.48, 0.8), float(angle))
    column = np.array(turn)[:, 0]
    row = [_engine.shape("box", tuple(2.0 * k * column), (2, 1, 1), rotation=turn) for k in range(4)]
    scene = Scene((f"{k}", [shape]) for k, shape in enumerate(row))
    assert union(scene).pieces == 1
    assert read_stl(scene.export(tmp_path / "row.stl", scale=20.0)).is_watertight


@pytest.mark.parametrize(
    "shape",
    [
        _engine.shape("box", (0, 0, 0), (1, 2, 3)),
        _engine.shape("box", (0, 0, 0), (1, 2, 3), taper=0.3),
        _engine.shape("cylinder", (0, 0, 0), 1.0, 2.0),
        _engine.shape("cylinder", (0, 0, 0), 1.0, 2.0, top_radius=0.2),
        _engine.shape("limb", (0, 0, 0), (1, 2, 0), 0.5, 0.3, (0, 1, 0), (1, 0, 0)),
        _engine.shape("extrude", [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (0, 1)], 2.0, twist=1.0),
        _engine.shape("revolve", [(2, 0), (3, 0), (2.5, 1), (2, 0)]),
        _engine.shape("sweep", [(0, 0), (0.2, 0), (0, 0.2)], [(0, 0, 0), (1, 0, 0), (1, 1, 1)]),
        _engine.shape("hull", [*TETRAHEDRON.tolist(), (0.1, 0.1, 0.1)]),
        _engine.shape("mesh", TETRAHEDRON, FACES),
    ],
    ids=lambda shape: shape.kind,
)
def test_every_kind_of_shape_is_a_solid(shape: Shape) -> None:
    solid = union(Scene([("one", [shape])]), scale=1.0, fuse=0.0)
    ((vertices, faces, *_),) = _engine.meshes([[shape]])
    assert solid.volume == pytest.approx(volume(vertices, faces), rel=1e-4)
    assert solid.pieces == 1 and closed(solid)


def closed(solid: Solid) -> bool:
    return bool(trimesh.Trimesh(solid.vertices, solid.faces, process=False).is_watertight)


def test_parts_that_are_not_solids_are_reported_by_address(tmp_path: Path) -> None:
    scene = Scene(
        [
            ("ship/hull", [box(0, 0, 0)]),
            ("ship/sail", [box(4, 0, 0), _engine.shape("mesh", TETRAHEDRON, FACES[:3])]),
            ("ship/keel", [_engine.shape("mesh", TETRAHEDRON, FACES[:, ::-1])]),
        ]
    )
    with pytest.raises(FileError) as caught:
        scene.export(tmp_path / "ship.stl")
    assert str(caught.value) == (
        "error[not-a-solid]: 2 of 4 shapes cannot be printed: they are not closed solids\n"
        " = why: ship/keel (its triangles face inwards); ship/sail, shape 2 (3 open edges)\n"
        " = help: close these meshes in your modelling program, or export .glb, .obj or .ply, which accept any mesh"
    )
    assert list(tmp_path.iterdir()) == []


def test_without_the_extra_the_message_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    with pytest.raises(FileError, match=r"pip install 'niwaki\[print\]'"):
        union(tower())


@pytest.mark.parametrize("setting", [{"scale": 0.0}, {"scale": float("nan")}, {"fuse": -1.0}, {"fuse": 9.0}])
def test_scale_and_fuse_are_lengths(setting: dict[str, float]) -> None:
    with pytest.raises(FileError) as caught:
        union(tower(), **setting)
    assert caught.value.code == "setting"


@pytest.mark.parametrize("suffix", ["stl", "3mf"])
def test_equal_scenes_give_equal_bytes(tmp_path: Path, suffix: str) -> None:
    first = tower().export(tmp_path / f"a.{suffix}").read_bytes()
    second = Scene(tower().parts[::-1]).export(tmp_path / f"a.{suffix}").read_bytes()
    assert first == second
    if suffix == "3mf":
        assert zipfile.ZipFile(tmp_path / "a.3mf").testzip() is None
