"""Marks as pixels, and the part of the plane that a drawing shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageChops, ImageDraw, ImageFilter

from niwaki.draw.assembly import Assembly
from niwaki.draw.flat.marks import Mark, Rgb, marks, style_of
from niwaki.draw.flat.strokes import Point
from niwaki.draw.limits import check_size

#: The factor of oversampling, for smooth edges.
FINE = 3

#: Low and high corner, (x, y) each, scene units.
Window = tuple[Point, Point]


def drawing(
    scene: Assembly,
    *,
    size: tuple[int, int] = (600, 600),
    style: str = "ink",
    window: Window | None = None,
    margin: float = 0.04,
    under: NDArray[np.bool_] | None = None,
    clear: bool = False,
    like: Assembly | None = None,
) -> Image.Image:
    """Draw a scene of flat shapes, seen from +z.

    Parameters
    ----------
    scene
        The scene.
    size
        Width and height in pixels.
    style
        "ink", "vines", "lightning" or "circuit".
    window
        The part of the plane to show; the whole scene when left out.
    margin
        Empty border around the scene, as a share of its size; a window has no border.
    under
        A pale image under the drawing, (rows, columns), which fills the window.
    clear
        Whether the paper is transparent.
    like
        The whole scene of which `scene` is a state; the drawing has its framing and its curves.

    Returns
    -------
    PIL.Image.Image
        The picture, RGBA.
    """
    chosen = style_of(style)
    check_size(size, fine=FINE)
    left, top, scale = framing(scene if like is None else like, window, size, margin)
    wide = size[0] * FINE, size[1] * FINE
    paper = tuple(round(255 * part) for part in chosen.paper)
    page = Image.new("RGBA", wide, (*paper, 0 if clear else 255))

    def at(point: Point) -> Point:
        return (point[0] - left) * scale * FINE, (top - point[1]) * scale * FINE

    if under is not None and window is not None:
        shade = Image.fromarray(np.where(under, np.uint8(255), np.uint8(0)), "L")
        (x, y), (right, low) = at((window[0][0], window[1][1])), at((window[1][0], window[0][1]))
        shade = shade.resize((round(right - x), round(low - y)), Image.Resampling.BICUBIC)
        tone = tuple(round(255 * (0.82 * part + 0.18 * (sum(chosen.paper) < 1.5))) for part in chosen.paper)
        page.paste((*tone, 255), (round(x), round(y)), shade)
    for blur, group in groupby(marks(scene, chosen, like), key=lambda mark: mark.blur):
        if blur == 0.0:
            _fill(page, list(group), at)
        else:
            page = _shine(page, list(group), at, blur * scale * FINE)
    return page.resize(size, Image.Resampling.BOX)


def framing(
    scene: Assembly, window: Window | None, size: tuple[int, int], margin: float
) -> tuple[float, float, float]:
    """Return the left and the upper border, scene units, and pixels for each unit; the window is in the middle."""
    if window is None:
        bounds = scene.bounds
        (x, y, _), (right, high, _) = bounds.tolist()
        pad = margin * max(right - x, high - y, 1e-9)
        window = ((x - pad, y - pad), (right + pad, high + pad))
    (x, y), (right, high) = window
    wide, tall = max(right - x, 1e-9), max(high - y, 1e-9)
    scale = min(size[0] / wide, size[1] / tall)
    return 0.5 * (x + right) - 0.5 * size[0] / scale, 0.5 * (y + high) + 0.5 * size[1] / scale, scale


def _fill(page: Image.Image, group: Sequence[Mark], at: Callable[[Point], Point]) -> None:
    pen = ImageDraw.Draw(page)
    for mark in group:
        pen.polygon([at(corner) for corner in mark.corners], fill=(*_bytes(mark.fill), 255))


def _shine(
    page: Image.Image, group: Sequence[Mark], at: Callable[[Point], Point], blur: float
) -> Image.Image:
    """Add light with the blend mode "screen", which never exceeds white."""
    light = Image.new("RGB", page.size)
    pen = ImageDraw.Draw(light)
    for mark in group:
        red, green, blue = (part * mark.opacity for part in mark.fill)
        pen.polygon([at(corner) for corner in mark.corners], fill=_bytes((red, green, blue)))
    # A blurred image needs few pixels.
    few = max(1, int(blur // 4))
    small = light.resize((max(1, page.width // few), max(1, page.height // few)), Image.Resampling.BOX)
    soft = small.filter(ImageFilter.GaussianBlur(blur / few)).resize(page.size, Image.Resampling.BICUBIC)
    lit = ImageChops.screen(page.convert("RGB"), soft).convert("RGBA")
    alpha = ImageChops.lighter(page.getchannel("A"), soft.convert("L"))
    lit.putalpha(alpha)
    return lit


def _bytes(color: Rgb) -> tuple[int, int, int]:
    red, green, blue = (round(255.0 * min(max(part, 0.0), 1.0)) for part in color)
    return red, green, blue
