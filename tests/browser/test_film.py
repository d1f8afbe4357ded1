"""The animation of the README, about twenty seconds: model, target, search, results, a held part, a drag, an export.

It is recorded for `make studio-pictures` alone, into `studio.gif` in the folder that `NIWAKI_PICTURES` names.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from studio_film import Clip, frame, write
from studio_page import at_rest, choose, click_part, settled, until, visible

#: The window and the frame, pixels; colours; milliseconds of a step, of a look, and of a longer look.
WINDOW, SIZE, COLORS = (1200, 760), (660, 418), 40
STEP, LOOK, LONG = 220, 1100, 1600
LIMIT = 1_000_000


class Film:
    """The frames so far."""

    def __init__(self, page):
        self.page, self.caption, self.pointer = page, "", None
        self.frames, self.durations = [], []
        self.clip = Clip(0, 0, *WINDOW, SIZE)

    def show(self, milliseconds=STEP):
        """Add a frame of the present page."""
        self.frames.append(frame(self.page, self.clip, self.pointer, self.caption))
        self.durations.append(milliseconds)

    def point(self, locator):
        """Move the pointer to the middle of a control."""
        box = locator.bounding_box()
        self.pointer = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        self.page.mouse.move(*self.pointer)


@pytest.mark.skipif("NIWAKI_PICTURES" not in os.environ, reason="only recorded for the manual")
def test_the_animation_of_the_readme(open_page, served):
    page = open_page(served, viewport=dict(zip(("width", "height"), WINDOW, strict=True)))
    settled(page)
    film = Film(page)
    film.caption = "Choose a model: a run of it is shown at once."
    until(
        page, "document.querySelectorAll('.models canvas[data-drawn]').length == 6 && window.__studio.isStill"
    )
    film.point(page.get_by_label("Model", exact=True))
    film.show(LONG)
    choose(page, "spaceship", 10, seed=3)
    page.get_by_role("slider", name="Variety").fill("0.5")
    until(page, "window.__studio.view.settings.strength == 0.5")
    page.evaluate("document.activeElement.blur()")
    settled(page)
    film.caption = "Choose what it grows into: the gallery's, your own mesh, or a drawing."
    film.point(page.get_by_label("Target", exact=True))
    until(page, "window.__studio.isStill")
    film.show(LONG)
    film.caption = "Grow."
    film.point(page.locator("button.primary"))
    film.show(500)
    page.locator("button.primary").click()
    bests = 0
    while page.evaluate(
        "window.__studio.view.searching !== null || window.__studio.view.results.length == 0"
    ):
        now = page.evaluate("window.__studio.bests")
        if now > bests:
            bests = now
            film.show()
    at_rest(page)
    film.caption = "Ten results that differ."
    until(page, "window.__studio.isStill")
    film.show(LOOK)
    for number in (2, 4, 0):
        card = page.locator("[role=option]").nth(number)
        film.point(card)
        card.click()
        until(page, f"window.__studio.view.picked.number == {number}")
        at_rest(page)
        until(page, "window.__studio.isStill")
        film.show(LOOK)
    film.caption = "Hold a part; the rest grows again."
    address = visible(page, "wings")
    box = page.locator("main.stage").bounding_box()
    x, y = page.evaluate("address => window.__studio.pointOf(address)", address)
    film.pointer = (box["x"] + x, box["y"] + y)
    click_part(page, address)
    until(page, f"window.__studio.selection.part == {json.dumps(address)} && window.__studio.isStill")
    film.show(LOOK)
    page.keyboard.press("h")
    until(page, "window.__studio.view.held.length == 1 && window.__studio.isStill")
    film.show(500)
    run = page.evaluate("window.__studio.view.picked.run")
    film.point(page.get_by_role("button", name="Grow the rest"))
    page.get_by_role("button", name="Grow the rest").click()
    until(page, f"!window.__studio.view.searching && window.__studio.view.picked.run != {run}")
    at_rest(page)
    until(page, "window.__studio.isStill")
    film.show(LONG)
    page.locator(".held .icon-button").first.click()
    until(page, "window.__studio.view.held.length == 0")
    film.caption = "Drag a part: choices that let it follow change."
    address = visible(page, "wings")
    x, y = page.evaluate("address => window.__studio.pointOf(address)", address)
    start = (box["x"] + x, box["y"] + y)
    click_part(page, address)
    until(page, f"window.__studio.selection.part == {json.dumps(address)}")
    page.mouse.move(*start)
    page.mouse.down()
    for step in range(1, 13):
        film.pointer = (start[0] + 5 * step, start[1] + 2 * step)
        moves = page.evaluate("window.__studio.shown.moves")
        page.mouse.move(*film.pointer)
        until(page, f"window.__studio.shown.moves > {moves} && window.__studio.isStill")
        film.show()
    run = page.evaluate("window.__studio.view.picked.run")
    page.mouse.up()
    until(page, f"window.__studio.view.picked.run != {run}")
    at_rest(page)
    until(page, "window.__studio.isStill")
    film.show(LOOK)
    film.caption = "Export it: a mesh, a picture, a recipe that makes it again."
    film.point(page.get_by_role("button", name="Export"))
    page.get_by_role("button", name="Export").click()
    until(page, "window.__studio.isStill")
    film.show(LONG)
    item = page.get_by_role("menuitem", name="GLB")
    film.point(item)
    with page.expect_download() as download:
        item.click()
    assert Path(download.value.path()).read_bytes().startswith(b"glTF")
    until(page, "window.__studio.isStill")
    film.show(2 * LONG)
    place = Path(os.environ["NIWAKI_PICTURES"], "studio.gif")
    write(film.frames, film.durations, place, COLORS)
    assert 15_000 < sum(film.durations) < 30_000 and place.stat().st_size < LIMIT
