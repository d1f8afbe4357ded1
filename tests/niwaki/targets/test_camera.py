"""Claim: a camera file gives its camera, and a camera that sees nothing gives an error."""

from __future__ import annotations

import json
from math import inf, nan, pi
from pathlib import Path
from typing import Any

import pytest
from niwaki import Camera, InputError
from niwaki.errors import FileError

GOOD: dict[str, Any] = {"kind": "perspective", "position": [0, 2, 20], "look_at": [0, 2, 0]}
FLAT: dict[str, Any] = {
    "kind": "orthographic",
    "position": [0, 9, 0],
    "look_at": [0, 0, 0],
    "up": [0, 0, -1],
    "height": 5,
}


@pytest.mark.parametrize("data", [GOOD, FLAT])
def test_a_file_and_its_camera(tmp_path: Path, data: dict[str, Any]) -> None:
    path = tmp_path / "cam.json"
    path.write_text(json.dumps(data))
    camera = Camera.load(path)
    assert camera == Camera.of(data) == Camera.of(camera) == Camera.of(str(path))
    assert {**camera.to_dict(), **data} == {**camera.to_dict()}
    assert Camera.load(camera.save(tmp_path / "again.json")) == camera


def test_defaults_are_those_of_the_published_cameras() -> None:
    camera = Camera.perspective((1, 2, 3), (0, 0, 0))
    assert (camera.up, camera.fov_degrees, camera.near) == ((0, 1, 0), 45, 0.1)
    assert camera.lens()[3:] == (True, pi / 4, 0.1)


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ({"kind": "fisheye"}, "'fisheye'"),
        ({"position": None}, "`position` is None"),
        ({"position": [0, 2]}, "three numbers"),
        ({"position": [0, nan, 0]}, "finite"),
        ({"look_at": [0, 2, 20]}, "position is its look_at"),
        ({"up": [0, 0, 1]}, "direction of view"),
        ({"up": [0, 0, 0]}, "direction of view"),
        ({"fov_degrees": 180}, "less than 180"),
        ({"fov_degrees": True}, "`fov_degrees`"),
        ({"near": 0}, "above 0"),
        ({"height": 3}, "no `height`"),
        ({"fov": 45}, "no `fov`"),
    ],
)
def test_cameras_that_see_nothing(change: dict[str, Any], part: str) -> None:
    with pytest.raises(InputError) as error:
        Camera.from_dict({**GOOD, **change}, name="cam.json")
    assert error.value.code == "bad-camera"
    assert part in str(error.value) and " = found: cam.json" in str(error.value)


def test_orthographic_cameras_need_a_height() -> None:
    for height in (None, 0, inf):
        with pytest.raises(InputError, match="height"):
            Camera.from_dict({**FLAT, "height": height})
    with pytest.raises(InputError, match="`height` is missing"):
        Camera.from_dict({key: value for key, value in FLAT.items() if key != "height"})


def test_files_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(FileError) as missing:
        Camera.load(tmp_path / "nowhere.json")
    (tmp_path / "cut.json").write_text('{"kind": "persp')
    with pytest.raises(FileError) as cut:
        Camera.load(tmp_path / "cut.json")
    (tmp_path / "list.json").write_text("[1, 2]")
    with pytest.raises(InputError) as other:
        Camera.load(tmp_path / "list.json")
    assert [missing.value.code, cut.value.code, other.value.code] == [
        "file-missing",
        "file-unreadable",
        "bad-camera",
    ]
