"""Pages of `niwaki.view` in a browser: they show and turn results, and send no requests."""

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
def open_file(browser, tmp_path):
    """A function that opens a page of one file. The page may send no other requests, and no script may fail."""
    context = browser.new_context(viewport={"width": 900, "height": 700}, bypass_csp=True)
    requests, errors = [], []

    def open_page(text: str):
        (tmp_path / "page.html").write_text(text)
        page = context.new_page()
        page.on("request", lambda request: requests.append(request.url))
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto((tmp_path / "page.html").as_uri())
        return page

    yield open_page
    assert errors == [] and all(url.startswith(("file://", "about:", "data:")) for url in requests)
    assert len([url for url in requests if url.startswith("file://")]) == 1
    context.close()


STAGE = "document.querySelector('body > div').stage"


def test_a_page_shows_its_results(open_file, ships):
    page = open_file(nw.view(ships).html())
    page.wait_for_function(f"{STAGE}?.frames > 0")
    best = max(ships, key=lambda ship: ship.log_score)
    parts = page.evaluate(f"{STAGE}.piece.header.parts")
    assert parts == [part.address for part in best.scene.parts]
    box = page.locator("canvas").bounding_box()
    part = next(part for part in parts if page.evaluate(f"{STAGE}.pointOf({part!r})"))
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
    other = min(ships, key=lambda ship: ship.log_score)
    assert page.evaluate(f"{STAGE}.piece.header.parts") == [part.address for part in other.scene.parts]
    shown = page.screenshot(clip={**box, "height": 400})
    frames = page.evaluate(f"{STAGE}.frames")
    page.get_by_role("button", name="Target").click()
    page.wait_for_function(f"{STAGE}.frames > {frames}")
    assert page.screenshot(clip={**box, "height": 400}) != shown


def test_a_frame_of_a_notebook_shows_the_same(open_file, ships):
    view: View = nw.view(ships.best)
    page = open_file(f"<!doctype html><body>{view._repr_html_()}</body>")
    inside = page.frames[1]
    inside.wait_for_function(f"{STAGE}?.frames > 0")
    assert inside.evaluate(f"{STAGE}.piece.header.triangles") > 100
