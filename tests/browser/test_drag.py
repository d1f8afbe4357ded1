"""Dragging a part in a browser: it moves to the pointer, or a line of text tells the reason; Esc cancels the drag.

For `make studio-pictures` a test also records the animation of the manual, into `out/studio/drag.gif`.
"""

from __future__ import annotations

import os

import numpy as np
import pytest
from niwaki import studio
from studio_film import Clip, frame, write
from studio_page import OUT, at_rest, choose, click_part, grow, picture, timed, until

#: The frames of the animation: size in pixels, colours, and duration, milliseconds.
SIZE, COLORS, STEP = (480, 400), 64, 90
#: Whether the animation is recorded; otherwise the pointer makes larger steps.
IS_RECORDED = bool(os.environ.get("NIWAKI_PICTURES"))
#: The share of the scene's height in a frame.
ZOOM = 0.86


@pytest.fixture
def tree(open_page, served):
    """A page with a tree that has grown into its target."""
    page = open_page(served)
    choose(page, "gnarly-tree", 1)
    grow(page)
    at_rest(page)
    page.keyboard.press("t")
    return page


def branches(page):
    """Find visible branches, the deepest first: the address and a visible point of each, in pixels of the page."""
    # No part follows a tip, so that it has room to move.
    places = page.evaluate("""(() => {
      const depth = (part) => part.split("branch").length;
      const parts = window.__studio.shown.parts.toSorted((a, b) => depth(b) - depth(a));
      const places = [];
      for (const part of parts) {
        const at = window.__studio.pointOf(part);
        if (at && places.push([part, at]) === 12) return places;
      }
      return places;
    })()""")
    box = page.locator("main.stage").bounding_box()
    return [(address, box["x"] + x, box["y"] + y) for address, (x, y) in places]


def clip_of(page):
    """The piece of the page in a frame: the middle of the scene."""
    box = page.locator("main.stage").bounding_box()
    height = ZOOM * box["height"]
    width = height * SIZE[0] / SIZE[1]
    return Clip(box["x"] + (box["width"] - width) / 2, box["y"] + 3, width, height, SIZE)


def test_a_branch_goes_to_the_pointer_and_the_rest_is_grown_again(tree):
    # A tip in the middle of others can meet one of them where it is dropped, which the page says.
    assert any(has_followed(tree, *place) for place in branches(tree))


def has_followed(page, address, x, y):
    """Drag a branch and drop it; return whether there was room for it and the rest was grown again."""
    page.evaluate("document.querySelectorAll('.notice .tiny').forEach((dismiss) => dismiss.click())")
    click_part(page, address)
    until(page, "window.__studio.selection.part")
    picked = page.evaluate("window.__studio.view.picked")
    before = np.array(page.evaluate("window.__studio.camera"))
    page.evaluate("document.activeElement.blur()")
    clip, frames = clip_of(page), []

    def record(count=1, at=None):
        if IS_RECORDED:
            frames.extend([frame(page, clip, at)] * count)

    record(6, (x, y))
    page.mouse.move(x, y)
    page.mouse.down()
    with timed("drag"):
        page.mouse.move(x + 9, y - 5, steps=2)
        until(page, "window.__studio.shown.role == 'moving'")
    for step in range(1, 15) if IS_RECORDED else (5, 10, 14):
        to = (x + 9 + 7 * step, y - 5 - 4 * step)
        moves = page.evaluate("window.__studio.shown.moves")
        page.mouse.move(*to)
        until(page, f"window.__studio.shown.moves > {moves} && window.__studio.isStill")
        record(1, to)
    drag = page.evaluate("window.__studio.drag")
    assert drag["left"] <= 0.01 or drag["reason"]
    record(6, to)
    page.keyboard.down("Shift")
    with timed("refit"):
        page.mouse.up()
        run = picked["run"]
        until(page, f"window.__studio.view.picked.run >= {run} + 2 || document.querySelector('.notice')")
    page.keyboard.up("Shift")
    if page.evaluate("window.__studio.view.picked.run") == run:
        assert "This part cannot be moved there." in page.locator(".notice").first.inner_text()
        # The branch is back in its place.
        until(page, "window.__studio.shown.role == 'result' && window.__studio.isStill")
        return False
    at_rest(page)
    until(page, "window.__studio.isStill")
    record(16)
    assert (np.array(page.evaluate("window.__studio.camera")) == before).all()
    if IS_RECORDED:
        write(frames, [STEP] * len(frames), OUT / "drag.gif", COLORS)
    return True


def test_escape_cancels_a_drag(tree):
    page = tree
    address, x, y = branches(page)[0]
    click_part(page, address)
    until(page, "window.__studio.selection.part")
    picked = page.evaluate("window.__studio.view.picked")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 40, y, steps=4)
    until(page, "window.__studio.shown.role == 'moving'")
    page.keyboard.press("Escape")
    at_rest(page)
    page.mouse.up()
    assert page.evaluate("window.__studio.view.picked") == picked
    assert page.evaluate("window.__studio.shown.role") == "result"


def test_a_change_of_the_file_is_offered_and_written_when_accepted(open_page, served, pile):
    text = pile.read_text()
    page = open_page(served)
    choose(page, str(pile), 1)
    with studio.connect(served.url, served.key) as script:
        script.ask("ask", ask={"target": {"source": "box", "scale": [2.0, 3.0, 2.0]}})
    grow(page)
    at_rest(page)
    page.keyboard.press("t")
    address = page.evaluate("window.__studio.shown.parts.find(part => part.includes('i[3]'))")
    x, y = page.evaluate("address => window.__studio.pointOf(address)", address)
    box = page.locator("main.stage").bounding_box()
    click_part(page, address)
    until(page, "window.__studio.selection.part")
    offer = page.locator(".offer").first
    # No choice moves a storey up; the height of the pile does, which is a number of the file.
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    page.mouse.move(box["x"] + x, box["y"] + y - 60, steps=4)
    until(page, "window.__studio.shown.role == 'moving'")
    page.mouse.up()
    at_rest(page)
    offer.locator("summary").click()
    assert "height: float = 3.0" in offer.inner_text()
    assert pile.read_text() == text
    picture(page, "offer")
    offer.get_by_role("button", name="Write", exact=True).click()
    until(page, "window.__studio.view.model.parameters[0].default > 3")
    assert "height: float = 3." in pile.read_text() and pile.read_text() != text
    pile.write_text(text)
