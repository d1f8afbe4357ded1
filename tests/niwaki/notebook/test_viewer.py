"""Claim: results have views in notebooks, and `view` makes a page that contains its meshes and loads nothing.

`tests/browser/test_view.py` opens the page in a browser.
"""

from __future__ import annotations

import base64
import html
import importlib.util
import json
import re
import time
import zlib
from html.parser import HTMLParser

import niwaki as nw
import numpy as np
import pytest
from niwaki.gallery import entries
from niwaki.gallery.coin import coin
from niwaki.gallery.spaceship import spaceship
from niwaki.notebook.viewer import stage
from niwaki.studio.frames import unpack


@pytest.fixture(scope="module")
def ships() -> nw.Result:
    return nw.grow(spaceship, nw.targets.examples.ship(), particles=50, voxel=0.25, runs=3, seed=1)


class Page(HTMLParser):
    """Parser of a page that checks nesting and lists the links that the page loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.loads: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.loads += [value for name, value in attrs if name in ("src", "href")]
        if tag not in ("img", "meta"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_a_result_is_a_picture_and_its_numbers(ships):
    shown = ships.best._repr_html_()
    assert all(link.startswith("data:image/png;base64,") for link in Page(shown).loads)
    assert f"{ships.best.log_score:.4g}" in shown and str(ships.best.fit) in shown
    assert ships._repr_html_() != shown and "samples" in ships._repr_html_()
    image = base64.b64decode(re.search(r"base64,([^\"]+)", shown)[1])
    assert image == ships.best._repr_png_()


def test_a_result_without_shapes_is_a_table():
    shown = nw.run(coin, method=nw.enumerate_all())._repr_html_()
    assert "<img" not in shown and "log evidence" in shown
    Page(shown)


def test_the_card_of_a_usual_result_is_quick(ships):
    ships._repr_html_()
    start = time.process_time()
    ships._repr_html_()
    # Processor time of all threads; ten times the time on an idle machine.
    assert time.process_time() - start < 4.0


@pytest.mark.parametrize("name", ["spaceship", "vines"])
def test_gallery_entries_are_tables(name):
    (entry,) = [entry for entry in entries() if entry.name == name]
    assert entry.title in entry._repr_html_()


def test_a_view_has_the_meshes_and_the_target(ships):
    view = nw.view(ships, most=2)
    headers = [json.loads(unpack(frame)[0]) for frame in view.frames]
    assert [header["role"] for header in headers] == ["ghost", "result", "result"]
    best = max(ships, key=lambda sample: sample.log_score)
    assert headers[1]["parts"] == [part.address for part in best.scene.parts]
    assert np.allclose([headers[1]["low"], headers[1]["high"]], best.scene.bounds, atol=0.05)
    assert len(nw.view(ships.best, target=False).frames) == 1
    assert len(nw.view([ships[0].scene, ships[1].scene]).frames) == 2


def test_a_view_is_a_page_that_loads_nothing(ships, tmp_path):
    text = nw.view(ships).save(tmp_path / "ships.html").read_text()
    assert Page(text).loads == []
    assert "default-src 'none'" in text
    held = re.search(r'id="niwaki-frames">(.*?)</script>', text)[1]
    assert [zlib.decompress(base64.b64decode(frame)) for frame in json.loads(held)] == nw.view(ships).frames
    frame = nw.view(ships)._repr_html_()
    assert html.unescape(re.search(r'srcdoc="([^"]*)"', frame)[1]) == text


def test_the_script_cannot_end_its_element():
    assert "</script" not in stage().lower()


def test_a_view_without_results_is_refused():
    with pytest.raises(nw.InputError, match="shown"):
        nw.view([])


@pytest.mark.skipif(importlib.util.find_spec("anywidget") is None, reason="anywidget is not installed")
def test_a_widget_has_the_same_frames(ships):
    widget = nw.view(ships).widget()
    assert widget.frames == nw.view(ships).frames
