"""Pictures of palettes: rows of swatches in columns with titles, or ribbons with a column for each palette."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from PIL import Image, ImageDraw, ImageFont

from niwaki.errors import FileError
from niwaki.words.vectors import VecLike, _vec

PAPER, INK = (250, 249, 246), (84, 82, 78)


def swatches(
    columns: Mapping[str, Sequence[Sequence[VecLike]]], *, swatch: int = 64, gap: int = 28
) -> Image.Image:
    """Draw palettes as swatches, in columns.

    Parameters
    ----------
    columns
        Palettes by the title of their column. A palette is a list of colours; a colour is three sRGB parts in [0, 1].
        Parts outside this range are clipped.
    swatch
        Width of a swatch in pixels; the height is a little larger.
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


def ribbons(
    rows: Mapping[str, Sequence[Sequence[VecLike]]], *, column: int = 3, tall: int = 120, gap: int = 18
) -> Image.Image:
    """Draw each sequence of palettes as a ribbon under its title; a palette is a column, its colours are bands.

    Parameters
    ----------
    rows
        Sequences of palettes by title; as for `swatches`.
    column
        Width of a palette in pixels.
    tall
        Height of a ribbon in pixels.
    gap
        Pixels around ribbons.
    """
    if not rows or not all(row and all(row) for row in rows.values()):
        raise FileError("setting", name="rows", found="a row without colours", expected="palettes")
    font = ImageFont.load_default(15)
    head = 24
    wide = column * max(map(len, rows.values()))
    page = Image.new("RGB", (wide + 2 * gap, gap + len(rows) * (head + tall + gap)), PAPER)
    pen = ImageDraw.Draw(page)
    for at, (title, row) in enumerate(rows.items()):
        top = gap + at * (head + tall + gap)
        pen.text((gap, top + head / 2 - 2), title, INK, font, anchor="lm")
        for place, palette in enumerate(row):
            edges = [top + head + round(tall * band / len(palette)) for band in range(len(palette) + 1)]
            left = gap + place * column
            for color, high, low in zip(palette, edges, edges[1:], strict=False):
                pen.rectangle((left, high, left + column - 1, low - 1), fill=_bytes(color))
    return page


def _bytes(color: VecLike) -> tuple[int, int, int]:
    red, green, blue = (round(255.0 * min(max(part, 0.0), 1.0)) for part in _vec(color))
    return (red, green, blue)
