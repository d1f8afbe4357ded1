"""A part that is dragged in a browser: it goes to the pointer or a line of text says why not; Esc takes it back.

The animation of the manual is recorded on the way, into `out/studio/drag.gif`.
"""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image
from studio_page import OUT, at_rest, choose, click_part, grow, timed, until

#: The frames of the animation: size in pixels, colours, and how long each is shown, milliseconds.
SIZE, COLORS, STEP = (420, 360), 48, 90


@pytest.fixture
def tree(open_page, served):
    """A tree that has grown into its target."""
    page = open_page(served)
    choose(page, "gnarly-tree", 1)
    grow(page)
    at_rest(page)
    page.keyboard.press("t")
    return page


def branch(page):
    """A branch that is seen well: its address and the point at which it is seen, in pixels of the page."""
    found = page.evaluate(
        "window.__studio.shown.parts.map(one => [one, window.__studio.pointOf(one)]).filter(([_, at]) => at)"
    )
    deep = [(one, at) for one, at in found if one.count("branch") >= 6] or found
    address, (x, y) = deep[len(deep) // 2]
    box = page.locator("main.stage").bounding_box()
    return address, box["x"] + x, box["y"] + y


def frame(page):
    box = page.locator("main.stage").bounding_box()
    side = min(box["width"], box["height"] * SIZE[0] / SIZE[1])
    clip = {
        "x": box["x"] + (box["width"] - side) / 2,
        "y": box["y"],
        "width": side,
        "height": side * SIZE[1] / SIZE[0],
    }
    with Image.open(io.BytesIO(page.screenshot(clip=clip))) as shot:
        return shot.convert("RGB").resize(SIZE, Image.Resampling.LANCZOS)


def test_a_branch_goes_to_the_pointer_and_the_rest_is_grown_again(tree):
    page = tree
    address, x, y = branch(page)
    click_part(page, address)
    until(page, "window.__studio.selection.part")
    picked = page.evaluate("window.__studio.view.picked")
    before = np.array(page.evaluate("window.__studio.camera"))
    frames = [frame(page)] * 4
    page.mouse.move(x, y)
    page.mouse.down()
    with timed("drag"):
        page.mouse.move(x + 12, y - 6, steps=3)
        until(page, "window.__studio.shown.what == 'moving'")
    for step in range(1, 9):
        page.mouse.move(x + 12 + 7 * step, y - 6 - 4 * step, steps=2)
        page.wait_for_timeout(120)
        frames.append(frame(page))
    drag = page.evaluate("window.__studio.drag")
    assert drag["left"] <= 0.01 or drag["reason"]
    page.keyboard.down("Shift")
    with timed("refit"):
        page.mouse.up()
        until(page, f"window.__studio.view.picked.run >= {picked['run']} + 2")
    page.keyboard.up("Shift")
    at_rest(page)
    page.wait_for_timeout(400)
    frames += [frame(page)] * 10
    assert (np.array(page.evaluate("window.__studio.camera")) == before).all()
    OUT.mkdir(parents=True, exist_ok=True)
    first, *rest = [one.quantize(COLORS, dither=Image.Dither.NONE) for one in frames]
    first.save(OUT / "drag.gif", save_all=True, append_images=rest, duration=STEP, loop=0, optimize=True)


def test_escape_takes_a_part_back(tree):
    page = tree
    address, x, y = branch(page)
    click_part(page, address)
    until(page, "window.__studio.selection.part")
    picked = page.evaluate("window.__studio.view.picked")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 40, y, steps=4)
    until(page, "window.__studio.shown.what == 'moving'")
    page.keyboard.press("Escape")
    at_rest(page)
    page.mouse.up()
    assert page.evaluate("window.__studio.view.picked") == picked
    assert page.evaluate("window.__studio.shown.what") == "result"
