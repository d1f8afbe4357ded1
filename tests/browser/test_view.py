"""A page that `niwaki.view` wrote, in a browser: it is drawn, can be turned, and asks for nothing."""

from __future__ import annotations

import niwaki as nw
import numpy as np
import pytest
from niwaki.gallery.spaceship import spaceship
from niwaki.notebook.viewer import View


@pytest.fixture(scope="module")
def ships() -> nw.Result:
    return nw.grow(spaceship, nw.targets.examples.ship(), particles=50, voxel=0.25, runs=2, seed=1)


@pytest.fixture
def seen(browser, tmp_path):
    """A function that opens a page of one file; nothing else may be asked for, and no script may fail."""
    context = browser.new_context(viewport={"width": 900, "height": 700}, bypass_csp=True)
    asked, errors = [], []

    def opened(text: str):
        (tmp_path / "page.html").write_text(text)
        page = context.new_page()
        page.on("request", lambda one: asked.append(one.url))
        page.on("pageerror", lambda one: errors.append(str(one)))
        page.goto((tmp_path / "page.html").as_uri())
        return page

    yield opened
    assert errors == [] and all(one.startswith(("file://", "about:", "data:")) for one in asked)
    assert len([one for one in asked if one.startswith("file://")]) == 1
    context.close()


STAGE = "document.querySelector('body > div').stage"


def test_a_page_shows_its_results(seen, ships):
    page = seen(nw.view(ships).html())
    page.wait_for_function(f"{STAGE}?.frames > 0")
    best = max(ships, key=lambda one: one.log_score)
    parts = page.evaluate(f"{STAGE}.piece.header.parts")
    assert parts == [part.address for part in best.scene.parts]
    box = page.locator("canvas").bounding_box()
    part = next(one for one in parts if page.evaluate(f"{STAGE}.pointOf({one!r})"))
    x, y = page.evaluate(f"{STAGE}.pointOf({part!r})")
    page.mouse.click(box["x"] + x, box["y"] + y)
    assert page.locator("output").inner_text() == part
    before = np.array(page.evaluate(f"{STAGE}.camera.position.toArray()"))
    page.mouse.move(box["x"] + 300, box["y"] + 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 420, box["y"] + 220, steps=4)
    page.mouse.up()
    assert np.linalg.norm(page.evaluate(f"{STAGE}.camera.position.toArray()") - before) > 0.1
    page.get_by_role("button", name="2", exact=True).click()
    other = min(ships, key=lambda one: one.log_score)
    assert page.evaluate(f"{STAGE}.piece.header.parts") == [part.address for part in other.scene.parts]
    shown = page.screenshot(clip={**box, "height": 400})
    page.get_by_role("button", name="Target").click()
    page.wait_for_timeout(300)
    assert page.screenshot(clip={**box, "height": 400}) != shown


def test_a_frame_of_a_notebook_shows_the_same(seen, ships):
    view: View = nw.view(ships.best)
    page = seen(f"<!doctype html><body>{view._repr_html_()}</body>")
    inside = page.frames[1]
    inside.wait_for_function(f"{STAGE}?.frames > 0")
    assert inside.evaluate(f"{STAGE}.piece.header.triangles") > 100
