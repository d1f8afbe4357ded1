"""Claim: a plan shows the outline of each shape in its colour, with higher shapes on top."""

from __future__ import annotations

import xml.etree.ElementTree as xml
from pathlib import Path

import niwaki as nw
import pytest
from niwaki.draw import plan
from niwaki.draw.scene import Scene
from niwaki.draw.swatches import swatches
from niwaki.errors import FileError

RED, BLUE = (0.9, 0.1, 0.1), (0.1, 0.1, 0.9)
FLOOR = [(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (-3.0, 3.0)]


@nw.model
def stack():  # type: ignore[no-untyped-def]
    """A small red box on a large blue box, to the right of the middle and behind it."""
    nw.emit(nw.box((1.0, 1.5, -1.0), (1.0, 1.0, 1.0), color=RED))
    nw.emit(nw.box((1.0, 0.5, -1.0), (2.0, 1.0, 2.0), color=BLUE))


def scene() -> Scene:
    return nw.run(stack, seed=1).scene


def test_higher_shapes_lie_on_top() -> None:
    low, high = plan.patches(scene())
    assert (low.height, high.height) == (1.0, 2.0)
    assert sorted(high.corners) == [(0.5, 0.5), (0.5, 1.5), (1.5, 0.5), (1.5, 1.5)]
    image = plan.plan(scene(), FLOOR, width=300)
    at = [image.getpixel(place) for place in ((195, 105), (155, 65), (60, 240))]
    for color, expected in zip(at, (RED, BLUE, plan.FLOOR), strict=True):
        assert all(abs(part - 255.0 * share) < 2.0 for part, share in zip(color, expected, strict=True))


def test_a_plan_is_written_as_svg_and_png(tmp_path: Path) -> None:
    root = xml.fromstring(plan.save(tmp_path / "plan.svg", scene(), FLOOR).read_text())
    assert [part.get("fill") for part in root] == ["#ede9e2", "#1a1ae5", "#e51a1a"]
    assert plan.save(tmp_path / "plan.png", scene()).stat().st_size > 500
    with pytest.raises(FileError, match="file-format"):
        plan.save(tmp_path / "plan.pdf", scene())
    with pytest.raises(FileError, match="scene-empty"):
        plan.plan(Scene([]))
    with pytest.raises(FileError, match="setting"):
        plan.plan(scene(), width=1)


def test_swatches_show_their_colours() -> None:
    page = swatches({"one": [[RED, BLUE]], "two": [[BLUE], [(2.0, -1.0, 0.5)]]}, swatch=40, gap=20)
    y = 40 // 1 + 20
    assert page.getpixel((30, y)) == (230, 26, 26)
    assert page.getpixel((70, y)) == (26, 26, 230)
    assert (255, 0, 128) in {color for _, color in page.getcolors(100_000)}
    with pytest.raises(FileError, match="setting"):
        swatches({"none": []})
