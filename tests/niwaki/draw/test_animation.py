"""Claim: in a moving picture the parts appear in the given order, and all other pixels stay."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from niwaki import _engine
from niwaki.draw.animation import animate, growth
from niwaki.draw.scene import Scene
from niwaki.errors import FileError, InputError
from PIL import Image

SMALL = {"size": (96, 72), "samples": 1}


def row(count: int = 4) -> Scene:
    """A row of boxes from left to right."""
    return Scene((f"box[{k}]", [_engine.shape("box", (2.0 * k, 0.5, 0), (1, 1, 1))]) for k in range(count))


def frames(path: Path) -> list[np.ndarray]:
    arrays = []
    with Image.open(path) as image:
        for k in range(image.n_frames):
            image.seek(k)
            arrays.append(np.asarray(image.convert("RGB"), dtype=int))
    return arrays


def changed(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Find columns with a pixel that differs by more than a palette's step."""
    return np.nonzero((np.abs(first - second).max(axis=2) > 40).any(axis=0))[0]


@pytest.mark.parametrize("suffix", ["gif", "apng"])
def test_parts_appear_from_left_to_right(tmp_path: Path, suffix: str) -> None:
    pictures = frames(growth(row(), tmp_path / f"row.{suffix}", azimuth=0.0, elevation=0.0, **SMALL))
    assert len(pictures) == 4
    middles = [changed(a, b).mean() for a, b in zip(pictures, pictures[1:], strict=False)]
    assert middles == sorted(middles) and middles[-1] - middles[0] > 20
    # Earlier parts do not change: the first box has the same pixels in every frame.
    start = changed(pictures[0], pictures[1]).min() - 6
    assert all(np.abs(frame[:, : start - 4] - pictures[0][:, : start - 4]).max() <= 24 for frame in pictures)


def test_the_order_of_appearing_can_be_given(tmp_path: Path) -> None:
    back = growth(row(), tmp_path / "row.gif", parts=row().parts[::-1], azimuth=0.0, elevation=0.0, **SMALL)
    pictures = frames(back)
    middles = [changed(a, b).mean() for a, b in zip(pictures, pictures[1:], strict=False)]
    assert middles == sorted(middles, reverse=True)


def test_many_parts_share_a_frame_and_the_last_has_all(tmp_path: Path) -> None:
    path = growth(row(10), tmp_path / "row.apng", frames=3, **SMALL)
    assert len(frames(path)) == 3
    alone = animate([row(10)], tmp_path / "all.apng", **SMALL)
    assert np.array_equal(frames(path)[-1], frames(alone)[0])


def test_time_and_size_are_as_given(tmp_path: Path) -> None:
    with Image.open(growth(row(), tmp_path / "row.gif", seconds=2.0, **SMALL)) as image:
        assert image.size == (96, 72)
        assert image.info["duration"] == 500 and image.info["loop"] == 0
        image.seek(3)
        assert image.info["duration"] == 2000


def test_states_may_be_empty_and_come_back(tmp_path: Path) -> None:
    pictures = frames(animate([Scene([]), row(), Scene([])], tmp_path / "blink.apng", **SMALL))
    assert np.array_equal(pictures[0], pictures[2]) and len(changed(pictures[0], pictures[1])) > 10


def test_bad_settings_are_refused_and_leave_nothing(tmp_path: Path) -> None:
    for name, states, settings, code in [
        ("row.mp4", [row()], {}, "file-format"),
        ("row.gif", [Scene([])], {}, "scene-empty"),
        ("row.gif", [row()], {"seconds": 0.0}, "setting"),
        ("row.gif", [row()], {"backdrop": "clear"}, "setting"),
    ]:
        with pytest.raises(FileError) as caught:
            animate(states, tmp_path / name, **{**SMALL, **settings})
        assert caught.value.code == code
    with pytest.raises(InputError, match="frames"):
        growth(row(), tmp_path / "row.gif", frames=0)
    assert list(tmp_path.iterdir()) == []
