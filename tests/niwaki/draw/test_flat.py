"""Claim: scenes of flat shapes are drawings: smooth where strokes continue, in the order of z, each part named."""

from __future__ import annotations

from math import atan2, hypot
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from niwaki import _engine, draw
from niwaki.draw.flat.drawing import drawing
from niwaki.draw.flat.marks import BOARD, STYLES, is_flat, marks
from niwaki.draw.flat.strokes import Stroke, curves
from niwaki.draw.flat.svg import identifier, svg
from niwaki.draw.scene import Scene
from niwaki.errors import FileError

Shape = _engine.Shape
RED, GREEN, BLUE = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def plant() -> Scene:
    return Scene(
        [
            ("branch/emit#1", [_engine.shape("stroke", (0, 0, 0), (0, 2, 0), 0.6, color=RED)]),
            ("branch/emit#2", [_engine.shape("ellipse", (0, 1, -1), 3.0, 1.0, 0.0, color=GREEN)]),
            ("branch/emit#3", [_engine.shape("disc", (0, 2, 1), 0.5, color=BLUE)]),
            ("branch/branch/emit#1", [_engine.shape("stroke", (0, 2, 0), (1, 4, 0), 0.5, color=RED)]),
            ("branch/branch#1/emit#1", [_engine.shape("stroke", (0, 2, 0), (-1, 4, 0), 0.5, color=RED)]),
        ]
    )


def turn(points: list[tuple[float, float]], first: int, last: int) -> float:
    (a, b), (c, d) = points[first], points[last]
    return atan2(d - b, c - a)


def test_curves_are_smooth_and_continue_into_the_last_stroke_of_a_fork() -> None:
    low = Stroke("a", (0.0, 0.0), (0.0, 2.0), 0.6, 0.6)
    left, right = (Stroke("b", (0.0, 2.0), (side, 3.5), 0.4, 0.3) for side in (-1.0, 1.0))
    trunk, branch, last = curves([low, left, right])
    end, start = turn(trunk.points, -2, -1), turn(last.points, 0, 1)
    assert end == pytest.approx(start, abs=0.12)
    assert abs(end - turn(branch.points, 0, 1)) > 0.5
    assert trunk.widths[-1] == last.widths[0] == branch.widths[0] == 0.6 and last.widths[-1] == 0.3
    assert (trunk.points[-1], last.points[-1]) == ((0.0, 2.0), (1.0, 3.5))
    assert [hypot(*point) for point in curves([low], bend=0.0)[0].points] == [0.0, 2.0]


def test_a_band_is_as_wide_as_its_stroke() -> None:
    (curve,) = curves([Stroke("a", (0.0, 0.0), (4.0, 0.0), 1.0, 0.5)])
    corners = np.array(curve.outline())
    assert corners.min(axis=0) == pytest.approx([-0.5, -0.5], abs=0.01)
    assert corners.max(axis=0) == pytest.approx([4.25, 0.5], abs=0.01)
    x, y = corners.T
    area = 0.5 * abs(np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1)))
    assert area == pytest.approx(3.0 + np.pi * (0.25 + 0.0625) / 2, rel=0.01)


def test_shapes_in_front_are_drawn_last() -> None:
    page = drawing(plant(), size=(400, 400), window=((-2.0, 0.0), (2.0, 4.0)))

    def at(x: float, y: float) -> Any:
        return page.getpixel((round((x + 2.0) * 100), round((4.0 - y) * 100)))

    assert at(0.0, 1.0) == (255, 0, 0, 255), "the stroke hides the ellipse"
    assert at(1.0, 1.0) == (0, 255, 0, 255)
    assert at(0.0, 1.9) == (0, 0, 255, 255), "the disc hides the stroke"
    assert at(-1.9, 0.1) == (255, 255, 255, 255)


@pytest.mark.parametrize("style", STYLES)
def test_every_style_draws_every_part(style: str) -> None:
    drawn = marks(plant(), STYLES[style])
    assert {mark.address for mark in drawn} == {part.address for part in plant()}
    page = np.asarray(drawing(plant(), size=(120, 120), style=style, clear=True))
    assert 0.05 < (page[:, :, 3] > 100).mean() < 0.95
    root = ElementTree.fromstring(svg(plant(), style=style))
    space = "{http://www.w3.org/2000/svg}"
    names = [group.get("id") for group in root.iter(f"{space}g")]
    assert len(names) == len(set(names))
    assert {f"{space}title"} == {group[0].tag for group in root.iter(f"{space}g")}
    assert {group[0].text for group in root.iter(f"{space}g")} == {part.address for part in plant()}


def test_an_id_is_a_name_and_shows_the_address() -> None:
    assert identifier("branch/branch/branch/emit#1") == "branch-x3.emit#1".replace("#", "-")
    assert identifier("arm[3]/emit") == "arm-3.emit"
    assert identifier("3/x") == "part.3.x"


def test_pictures_and_files_of_flat_scenes_are_drawings(tmp_path: Path) -> None:
    scene = plant()
    assert is_flat(scene)
    picture = scene.picture(size=(90, 60), style="circuit")
    assert picture.size == (90, 60)
    assert picture.getpixel((1, 1)) == (*(round(255 * part) for part in BOARD), 255)
    assert scene.export(tmp_path / "plant.svg", style="vines").read_text().startswith("<svg")
    # In a GLB the shapes are plates in space.
    assert scene.export(tmp_path / "plant.glb").stat().st_size > 1000
    assert draw.sheet.sheet([scene, scene], size=(60, 60), style="vines").size[1] == 60
    assert scene.animate(tmp_path / "plant.gif", style="lightning").stat().st_size > 1000
    solid = Scene([("a", [_engine.shape("box", (0, 0, 0), (1, 1, 1))])])
    with pytest.raises(FileError, match="not a drawing"):
        solid.export(tmp_path / "box.svg")
    with pytest.raises(FileError, match="style"):
        scene.export(tmp_path / "plant.glb", style="vines")
    with pytest.raises(FileError, match="watercolour"):
        scene.picture(style="watercolour")
