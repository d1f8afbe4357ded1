"""Palettes of colours as rows of swatches, several columns of them under titles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PIL import Image, ImageDraw, ImageFont

from niwaki.file_errors import FileError
from niwaki.words.vectors import VecLike, _vec

PAPER, INK = (250, 249, 246), (84, 82, 78)


def swatches(
    columns: Mapping[str, Sequence[Sequence[VecLike]]], *, swatch: int = 64, gap: int = 28
) -> Image.Image:
    """Draw palettes.

    Parameters
    ----------
    columns
        Palettes by the title of their column. A palette is a list of colours, a colour three sRGB parts in [0, 1];
        what lies outside is drawn as the nearest that a screen can show.
    swatch
        Width of a swatch in pixels; it is a little taller.
    gap
        Pixels between palettes.
    """
    if not columns or not all(column and all(column) for column in columns.values()):
        raise FileError("setting", name="columns", found="a column without colours", expected="palettes")
    tall = round(1.35 * swatch)
    font = ImageFont.load_default(max(11, round(swatch / 3.6)))
    head = round(swatch / 1.6)
    widths = [swatch * max(map(len, column)) for column in columns.values()]
    rows = max(map(len, columns.values()))
    size = (gap + sum(width + gap for width in widths), head + gap + rows * (tall + gap))
    page = Image.new("RGB", (2 * size[0], 2 * size[1]), PAPER)
    pen = ImageDraw.Draw(page)
    left = gap
    for width, column in zip(widths, columns.values(), strict=True):
        for row, palette in enumerate(column):
            top = head + gap // 2 + row * (tall + gap)
            for at, color in enumerate(palette):
                x = left + at * swatch
                pen.rectangle(
                    (2 * x, 2 * top, 2 * (x + swatch) - 1, 2 * (top + tall) - 1), fill=_bytes(color)
                )
        left += width + gap
    page = page.resize(size, Image.Resampling.LANCZOS)
    pen, left = ImageDraw.Draw(page), gap
    for width, title in zip(widths, columns, strict=True):
        pen.text((left + width / 2, (head + gap // 2) / 2), title, INK, font, anchor="mm")
        left += width + gap
    return page


def _bytes(color: VecLike) -> tuple[int, int, int]:
    red, green, blue = (round(255.0 * min(max(part, 0.0), 1.0)) for part in _vec(color))
    return (red, green, blue)
