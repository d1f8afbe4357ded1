"""Claim: a sheet has a cell for each scene, and bad settings give an error."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from niwaki import _engine
from niwaki.draw.palette import OBSTACLE
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


@pytest.mark.parametrize("backdrop", ["studio", "slate"])
def test_an_obstacle_has_a_colour_of_its_own_beside_the_target(backdrop: str) -> None:
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 2) for z in (0, 2)], dtype=float)
    sides = trimesh.convex.convex_hull(corners)
    aim, wall = (
        Target(sides.vertices + (x, 0, 0), sides.faces, name) for x, name in ((-2, "aim"), (2, "wall"))
    )
    eye = ((0.5, 1.0, 12.0), (0.5, 1.0, 0.0), (0.0, 1.0, 0.0), 30.0)
    settings = {"size": (120, 60), "samples": 4, "backdrop": backdrop, "camera": eye}
    views = [((), aim), ((wall,), None), ((wall,), aim)]
    target, obstacle, both = (
        np.asarray(blocks(1)[0].picture(shown, obstacles=solids, **settings), dtype=int)
        for solids, shown in views
    )
    # The left side has the target, the right side the obstacle; the colours are those of each alone.
    assert abs(both[:, :40] - target[:, :40]).max() <= 1
    assert abs(both[:, -40:] - obstacle[:, -40:]).max() <= 1
    blue, red = (side[..., 2] - side[..., 0] for side in (both[:, :40], both[:, -40:]))
    assert blue.max() > 20 and red.min() < -20
    # Graphics need a contrast of 3 to 1 (WCAG 2.2, 1.4.11).
    paper = {"studio": (0.953, 0.945, 0.925), "slate": (0.114, 0.118, 0.129)}[backdrop]
    dark, light = sorted(
        luminance(color) for color in (paper, OBSTACLE["dark" if backdrop == "slate" else "light"])
    )
    assert (light + 0.05) / (dark + 0.05) > 3


def luminance(color: tuple[float, float, float]) -> float:
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in color]
    return float(np.dot(linear, (0.2126, 0.7152, 0.0722)))


def test_a_long_caption_takes_two_lines_and_is_not_cut_off() -> None:
    settings = {"size": (240, 180), "samples": 1}
    short, long = "#1", "#1   51.9 % covered, 7.4 % outside   seed 1   -4.71"
    low, high = (sheet(blocks(1), [text], **settings).size[1] for text in (short, long))
    font = ImageFont.load_default(11)
    assert low < high
    assert [part for line in _lines(long, font, 229) for part in line.split()] == long.split()
    assert all(font.getlength(line) <= 229 for line in _lines(long, font, 229))
