"""Claim: every format keeps a target's coordinates, and bad files give an error, never a result."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
import trimesh
from niwaki.errors.files import FILE_MESSAGES, FileError
from niwaki.targets.target import Target, TargetWarning


def cube(at: tuple[float, float, float] = (10.0, 20.0, 30.0)) -> trimesh.Trimesh:
    mesh = trimesh.creation.box((1.0, 2.0, 3.0))
    mesh.apply_translation(at)
    return mesh


@pytest.mark.parametrize("suffix", ["obj", "stl", "ply", "glb"])
def test_formats_keep_coordinates(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"cube.{suffix}"
    cube().export(path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        target = Target.load(path)
    assert target.bounds.tolist() == [[9.5, 19.0, 28.5], [10.5, 21.0, 31.5]]
    assert target.open_edges == 0
    assert len(target.faces) == 12
    assert target.volume == pytest.approx(6.0)


def test_a_file_with_several_objects_is_one_target(tmp_path: Path) -> None:
    path = tmp_path / "two.glb"
    scene = trimesh.Scene()
    move = trimesh.transformations.translation_matrix((5.0, 0.0, 0.0))
    scene.add_geometry(cube((0.0, 0.0, 0.0)), node_name="here")
    scene.add_geometry(cube((0.0, 0.0, 0.0)), node_name="there", transform=move)
    scene.export(path)
    target = Target.load(path)
    assert target.volume == pytest.approx(12.0)
    assert target.size.tolist() == [6.0, 2.0, 3.0]


def test_an_open_mesh_is_counted(tmp_path: Path) -> None:
    path = tmp_path / "open.obj"
    mesh = cube()
    mesh.update_faces(np.arange(12) > 0)
    mesh.export(path)
    with pytest.warns(TargetWarning, match="3 open edges"):
        assert Target.load(path).open_edges == 3


def code(path: Path) -> str:
    with pytest.raises(FileError) as caught:
        Target.load(path)
    text = str(caught.value)
    assert text.startswith(f"error[{caught.value.code}]: ") and path.name in text
    assert " = why: " in text and " = help: " in text
    return caught.value.code


def test_bad_files_are_refused(tmp_path: Path) -> None:
    assert code(tmp_path / "nowhere.obj") == "file-missing"
    (tmp_path / "notes.txt").write_text("hello")
    assert code(tmp_path / "notes.txt") == "file-format"
    for suffix in ("obj", "stl", "ply", "glb"):
        (tmp_path / f"nothing.{suffix}").write_bytes(b"")
        assert code(tmp_path / f"nothing.{suffix}") == "file-unreadable"
    (tmp_path / "points.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    assert code(tmp_path / "points.obj") in {"target-empty", "file-unreadable"}
    (tmp_path / "nan.obj").write_text("v 0 0 0\nv 1 0 nan\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
    assert code(tmp_path / "nan.obj") == "target-not-finite"
    (tmp_path / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")
    assert code(tmp_path / "flat.obj") == "target-flat"


@pytest.mark.parametrize("suffix", ["stl", "ply", "glb"])
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_files_cut_short_are_refused(tmp_path: Path, suffix: str, share: float) -> None:
    whole = tmp_path / f"whole.{suffix}"
    trimesh.creation.icosphere(2).export(whole)
    data = whole.read_bytes()
    cut = tmp_path / f"cut.{suffix}"
    cut.write_bytes(data[: int(len(data) * share)])
    assert code(cut) in {"file-unreadable", "target-empty"}


def test_a_face_beyond_the_last_vertex_is_refused(tmp_path: Path) -> None:
    (tmp_path / "beyond.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 9\n")
    assert code(tmp_path / "beyond.obj") == "file-unreadable"


def test_every_message_renders() -> None:
    class Anything(dict):  # type: ignore[type-arg]
        def __missing__(self, key: str) -> str:
            return key

    for name, texts in FILE_MESSAGES.items():
        title, why, help = (text.format_map(Anything(found=1)) for text in texts)
        assert title and why and help, name
        assert title[0] in "`" or title[0].islower(), name
        assert not title.endswith("."), name
