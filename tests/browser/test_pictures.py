"""Claim: the page looks as it was approved, in small and large windows, light and dark, compared with stored pictures.

The pictures are a quarter of the page's size, in 16 greys. `--update-golden` writes them again; look at them before a
commit. The page brings its font, so that the pictures depend little on the machine.
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from studio_page import at_rest, choose, grow, resize, until

GOLDEN = Path(__file__).parents[1] / "golden" / "studio"
SIZES = [(1024, 700), (1440, 900), (1920, 1080)]
#: Pixels of the page for a pixel of a picture, and greys of a picture.
SCALE, GREYS = 4, 16
#: The sides of the blocks that are compared, pixels of a picture, and their greatest mean difference, of 255 greys.
BLOCK, MOST = 8, 12.0
#: The most pictures that are taken until the page has all of its contents.
TRIES = 100


def small(page) -> Image.Image:
    """Take a picture of the page: small, in few greys."""
    until(page, "window.__studio.isStill")
    with Image.open(io.BytesIO(page.screenshot(animations="disabled", caret="hide"))) as full:
        grey = full.convert("L").reduce(SCALE)
    step = 255 / (GREYS - 1)
    levels = np.rint(np.asarray(grey) / step)
    return Image.fromarray(np.rint(levels * step).astype(np.uint8))


def differing(picture: Image.Image, stored: Image.Image) -> list[tuple[int, int]]:
    """List the places, pixels of the page, of blocks that differ."""
    first, second = (np.asarray(image, dtype=float) for image in (picture, stored))
    if first.shape != second.shape:
        return [(0, 0)]
    high, wide = (side // BLOCK * BLOCK for side in first.shape)
    blocks = np.abs(first - second)[:high, :wide].reshape(high // BLOCK, BLOCK, wide // BLOCK, BLOCK)
    rows, columns = np.nonzero(blocks.mean(axis=(1, 3)) > MOST)
    return [(int(x) * BLOCK * SCALE, int(y) * BLOCK * SCALE) for y, x in zip(rows, columns, strict=True)]


@pytest.fixture(scope="module")
def grown(served):
    """Whether the session has its results."""
    return []


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_page_looks_as_approved(open_page, served, grown, theme, request):
    page = open_page(served, color_scheme=theme)
    if not grown:
        choose(page, "spaceship", 6, seed=3)
        grow(page)
        grown.append(True)
    at_rest(page)
    # The target is a part of what the camera frames.
    until(page, "window.__studio.ghost > 0")
    for wide, high in SIZES:
        resize(page, wide, high)
        page.keyboard.press("f")
        until(page, "window.__studio.isStill")
        page.keyboard.press("f")
        shot, place = small(page), GOLDEN / f"{wide}x{high}-{theme}.png"
        if request.config.getoption("--update-golden"):
            GOLDEN.mkdir(parents=True, exist_ok=True)
            shot.quantize(GREYS, dither=Image.Dither.NONE).save(place, optimize=True)
        with Image.open(place) as file:
            stored = file.convert("L")
        # Fine meshes and small pictures of results arrive after the page is still for the first time.
        for _ in range(TRIES):
            if not differing(shot, stored):
                break
            # What covers the view decides how the camera frames it, and is measured after it is laid out.
            page.keyboard.press("f")
            shot = small(page)
        assert differing(shot, stored) == [], f"{place.name}: look at the page, then --update-golden"
    # A panel that moves by as little as this is found.
    page.add_style_tag(content=".side { padding-left: 8px }")
    assert len(differing(small(page), shot)) > 20
