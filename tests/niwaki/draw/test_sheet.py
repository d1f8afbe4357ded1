"""Claim: a sheet has a cell for each scene, and bad settings give an error."""

from __future__ import annotations

import numpy as np
import pytest
from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.draw.sheet import _lines, sheet
from niwaki.errors import FileError, InputError
from niwaki.targets.sketches import avoid, floor
from niwaki.targets.target import Target
from PIL import ImageFont


def blocks(count: int) -> list[Scene]:
    return [Scene([("block", [_engine.shape("box", (0, 0, 0), (1, 1 + k, 1))])]) for k in range(count)]


def test_rows_and_columns() -> None:
    settings = {"size": (80, 60), "samples": 1}
    assert sheet(blocks(5), **settings).size == (3 * 82 - 2, 2 * 62 - 2)
    assert sheet(blocks(3), columns=1, **settings).size == (80, 3 * 62 - 2)
    named = sheet(blocks(2), ["one", "a caption that is far too long for its cell"], **settings)
    assert named.size[1] > 60


def test_bad_settings_are_refused() -> None:
    with pytest.raises(FileError, match="scene-empty"):
        sheet([])
    with pytest.raises(FileError, match="captions"):
        sheet(blocks(2), ["one"])
    with pytest.raises(InputError, match="columns"):
        sheet(blocks(2), columns=0)


def test_obstacles_are_ghosts_and_the_floor_is_where_it_was_asked_for() -> None:
    wall = Target(
        [[3, 0, 0], [3, 2, 0], [3, 2, 2], [4, 0, 0]], [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]], "wall"
    )
    score = avoid(wall, 0.5) * floor(-1.0)
    assert score.surroundings == {"obstacles": [wall], "ground": -1.0} and floor(0.0).surroundings == {
        "ground": 0.0
    }
    settings = {"size": (80, 60), "samples": 1, "margin": 0.5}
    plain, walled, lowered = (
        np.asarray(sheet(blocks(1), **settings, **around))
        for around in ({}, {"obstacles": [wall]}, {"ground": -1.0})
    )
    # The framing is the same, so all that differs is the obstacle, or the shadow on a lower floor.
    assert 20 < (plain != walled).any(axis=2).sum() < 2000
    assert (plain != lowered).any()


def test_a_long_caption_takes_two_lines_and_is_not_cut_off() -> None:
    settings = {"size": (240, 180), "samples": 1}
    short, long = "#1", "#1   51.9 % covered, 7.4 % outside   seed 1   -4.71"
    low, high = (sheet(blocks(1), [text], **settings).size[1] for text in (short, long))
    font = ImageFont.load_default(11)
    assert low < high
    assert [part for line in _lines(long, font, 229) for part in line.split()] == long.split()
    assert all(font.getlength(line) <= 229 for line in _lines(long, font, 229))
