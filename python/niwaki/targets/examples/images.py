"""Images to match, drawn by code: white where a part or a shadow should be, black elsewhere.

The images are greyscale Pillow images. Shapes are drawn four times as large and made smaller, so that their edges are
smooth.
"""

from __future__ import annotations

from collections.abc import Sequence

from PIL import Image, ImageDraw

from niwaki.targets.examples.lofts import curve

Point = tuple[float, float]

#: The factor by which a picture is drawn larger than its final size.
FINE = 4

#: From throat to hairline: the line that makes a profile a face.
PROFILE = [
    (116, 206), (112, 198), (98, 195), (86, 190), (79, 182), (78, 173), (82, 166), (77, 160), (76, 156), (81, 152),
    (75, 147), (76, 142), (79, 137), (72, 133), (62, 129), (61, 124), (68, 113), (76, 102), (79, 93), (76, 84),
    (77, 70), (84, 56), (97, 44),
]  # fmt: skip


def skyline() -> Image.Image:
    """Draw a town's outline, 200 square: a stepped block, a gap, a broad block with a tall tower, a low one."""
    image, pen = _sheet(200)
    base = 128
    roofs = [(9, 20, 50), (20, 34, 66), (34, 60, 80), (60, 72, 30), (72, 112, 58), (112, 146, 112)]
    for left, right, height in [*roofs, (146, 165, 46), (165, 199, 28)]:
        pen.rectangle(_fine([(left, base - height), (right, base)]), fill=255)
    return _small(image)


def ship_front() -> Image.Image:
    """Draw a ship seen from its nose, 250 square: a round body with a fin, struts, pods, a disc at each tip."""
    image, pen = _sheet(250)
    x, y = 125, 132
    _disc(pen, (x, y), 21)
    pen.rectangle(_fine([(x - 6.5, y - 52), (x + 6.5, y)]), fill=255)
    for side in (1, -1):
        for near, far, half in ((0, 47, 5.5), (60, 98, 5.5)):
            left, right = sorted([x + side * near, x + side * far])
            pen.rectangle(_fine([(left, y - half), (right, y + half)]), fill=255)
        ends = sorted([x + side * 44, x + side * 76])
        pen.rounded_rectangle(_fine([(ends[0], y - 12), (ends[1], y + 12)]), radius=5 * FINE, fill=255)
        _disc(pen, (x + side * 95, y), 14)
    return _small(image)


def face() -> Image.Image:
    """Draw a head in profile, 250 square, facing left; the neck and the back are cut straight."""
    image, pen = _sheet(250)
    front = [tuple(p) for p in curve(PROFILE, 6)]
    crown = [tuple(p) for p in curve([(97, 44), (118, 34), (142, 31), (166, 37), (184, 50), (190, 60)], 6)]
    pen.polygon(_fine([*front, *crown, (190, 222), (122, 222)]), fill=255)
    return _small(image)


def face_stroke() -> Image.Image:
    """Draw a thick stroke along the profile of the face, 250 square: where a wrong pixel matters most."""
    image, pen = _sheet(250)
    _stroke(pen, [tuple(p) for p in curve([(122, 222), *PROFILE], 6)], 18)
    return _small(image)


def digits() -> Image.Image:
    """Draw a four and a two of straight strokes, joined by a thin bridge through the middle, 250 square.

    Pipes run along the axes, and so do the strokes; the first pipe stands above the bridge.
    """
    image, pen = _sheet(250)
    _stroke(pen, [(50, 62), (50, 125), (108, 125)], 9)
    _stroke(pen, [(96, 62), (96, 190)], 9)
    _stroke(pen, [(142, 62), (198, 62), (198, 125), (142, 125), (142, 190), (198, 190)], 9)
    _stroke(pen, [(108, 125), (142, 125)], 4)
    return _small(image)


def _sheet(size: int) -> tuple[Image.Image, ImageDraw.ImageDraw]:
    image = Image.new("L", (FINE * size, FINE * size))
    return image, ImageDraw.Draw(image)


def _fine(points: Sequence[Point]) -> list[Point]:
    return [(FINE * x, FINE * y) for x, y in points]


def _disc(pen: ImageDraw.ImageDraw, center: Point, radius: float) -> None:
    x, y = center
    pen.ellipse(_fine([(x - radius, y - radius), (x + radius, y + radius)]), fill=255)


def _stroke(pen: ImageDraw.ImageDraw, points: Sequence[Point], width: float) -> None:
    pen.line(_fine(points), fill=255, width=round(FINE * width), joint="curve")
    for point in points:
        _disc(pen, point, 0.5 * width)


def _small(image: Image.Image) -> Image.Image:
    return image.resize((image.width // FINE, image.height // FINE), Image.Resampling.BOX)
