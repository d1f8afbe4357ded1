"""The manual's pictures of images and shadows: a ship from its front, and a ship whose shadow is a plane.

python benches/views.py docs/pictures
"""

from __future__ import annotations

import sys
from pathlib import Path

from niwaki.gallery.spaceship import spaceship
from niwaki.methods import smc
from niwaki.search import run
from niwaki.targets.camera import Camera
from niwaki.targets.sketches import Score, match_image, match_shadow, no_self_intersection
from niwaki.targets.target import Receiver
from niwaki.targets.views import view_sheet
from pictures import written
from PIL import Image, ImageDraw

SIZE = 250
#: Drawn larger and made smaller: edges between black and white count as on.
FINE = 4


def draw(folder: Path) -> list[Path]:
    """Draw both pictures into a folder, which is made where it is missing."""
    folder.mkdir(parents=True, exist_ok=True)
    return [
        written(
            folder / "front.png", grown(match_image(front(), Camera.perspective((0, 0.6, 16), (0, 0.6, 0))))
        ),
        written(folder / "shadow.png", grown(shadow())),
    ]


def grown(score: Score) -> Image.Image:
    """The best of a thousand ships, as its sketch sees it."""
    result = run(spaceship, score=no_self_intersection() * score, method=smc(1000, power=16.0), seed=2)
    return view_sheet(result.best.scene, score.views[0], height=300)


def shadow() -> Score:
    """A plane's shadow on a floor below, by a light that comes a little from the side."""
    floor = Receiver.floor(-4.0, (-20.0, -20.0), (20.0, 20.0))
    above = Camera.perspective((1.2, 24, 2.4), (1.2, -4, 2.4), (0, 0, 1))
    return match_shadow(plane(), (0.3, -1.0, 0.2), floor, above, sigma=0.01)


def front() -> Image.Image:
    """A ship's front: a round body with an upright fin; to each side a strut, a pod, a strut and a disc."""
    page, pen = _page()
    _disc(pen, 125, 140, 21)
    _block(pen, 119, 90, 131, 140)
    for side in (-1, 1):
        _block(pen, 125, 135, 125 + side * 84, 145)
        _block(pen, 125 + side * 42, 128, 125 + side * 64, 152)
        _disc(pen, 125 + side * 95, 140, 14)
    return _small(page)


def plane() -> Image.Image:
    """A plane from above: a pointed body, swept wings, a tail."""
    page, pen = _page()
    _shape(pen, [(125, 35), (134, 60), (135, 205), (115, 205), (116, 60)])
    for side in (-1, 1):
        _shape(pen, [(125 + side * x, y) for x, y in ((5, 95), (70, 120), (70, 150), (5, 150))])
        _shape(pen, [(125 + side * x, y) for x, y in ((5, 185), (30, 195), (30, 210), (5, 208))])
    return _small(page)


def _page() -> tuple[Image.Image, ImageDraw.ImageDraw]:
    page = Image.new("L", (SIZE * FINE, SIZE * FINE))
    return page, ImageDraw.Draw(page)


def _disc(pen: ImageDraw.ImageDraw, x: float, y: float, radius: float) -> None:
    pen.ellipse([FINE * c for c in (x - radius, y - radius, x + radius, y + radius)], fill=255)


def _block(pen: ImageDraw.ImageDraw, x: float, y: float, other_x: float, other_y: float) -> None:
    (left, right), (top, bottom) = sorted((x, other_x)), sorted((y, other_y))
    pen.rectangle([FINE * c for c in (left, top, right, bottom)], fill=255)


def _shape(pen: ImageDraw.ImageDraw, points: list[tuple[float, float]]) -> None:
    pen.polygon([(FINE * x, FINE * y) for x, y in points], fill=255)


def _small(page: Image.Image) -> Image.Image:
    return page.resize((SIZE, SIZE), Image.Resampling.BOX)


if __name__ == "__main__":
    for place in draw(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/pictures")):
        print(f"{place}   {place.stat().st_size / 1000:.0f} kB")
