"""Colourings as files: SVG and PNG, one sheet of all, their colours, and the residuals of the rules."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from niwaki.color.search import Coloring
from niwaki.draw.finite import json_text
from niwaki.errors.files import write_whole

PAPER, INK = (250, 249, 246), (84, 82, 78)


def sheet(colorings: Sequence[Coloring], columns: int = 4, size: int = 320) -> Image.Image:
    """Draw all colourings on one page, numbered.

    Parameters
    ----------
    columns
        Pictures in a row.
    size
        Pixels of the longer side of each picture.
    """
    images = [coloring.image(2 * size).convert("RGBA") for coloring in colorings]
    if any(max(image.size) > size for image in images):
        images = [_shrunk(image, size) for image in images]
    width, height = images[0].size
    gap, strip = max(4, size // 20), max(14, size // 13)
    across = min(columns, len(images))
    down = -(-len(images) // across)
    page = Image.new("RGB", (across * (width + gap) + gap, down * (height + strip + gap) + gap), PAPER)
    pen, font = ImageDraw.Draw(page), ImageFont.load_default(round(0.6 * strip))
    for k, image in enumerate(images):
        x, y = gap + k % across * (width + gap), gap + k // across * (height + strip + gap)
        page.paste(image, (x, y), image)
        pen.text((x + width / 2, y + height + 0.55 * strip), f"{k + 1}", INK, font, anchor="mm")
    return page


def table(colorings: Sequence[Coloring]) -> list[list[str]]:
    """Tabulate the rules: kind, regions and goal of each, and its residual in each colouring, CIELAB units."""
    rows = [["rule", "first", "second", "wanted", *(f"{k + 1:02}" for k in range(len(colorings)))]]
    reports = [coloring.report for coloring in colorings]
    for k, first in enumerate(reports[0]):
        misses = [f"{report[k].residual:.2f}" for report in reports]
        rows.append([first.rule.kind, first.rule.first, first.rule.second, f"{first.goal:g}", *misses])
    return rows


def contents(colorings: Sequence[Coloring], size: int = 1024) -> dict[str, Callable[[], bytes]]:
    """Return the files of colourings: functions that write the bytes, by name.

    The files are `sheet.png`; `01.png` and, for an SVG drawing, `01.svg`, and so on; `colors.json` with the colours by
    file and region; `residuals.csv` with a row for each rule. Of each kind of file, the first shows most.
    """
    colors = {f"{k + 1:02}": coloring.colors for k, coloring in enumerate(colorings)}
    files: dict[str, Callable[[], bytes]] = {"sheet.png": lambda: _png(sheet(colorings))}
    for name, coloring in zip(colors, colorings, strict=True):
        files[f"{name}.png"] = lambda coloring=coloring: _png(coloring.image(size))  # type: ignore[misc]
        if (artwork := coloring.drawing.artwork) is not None:
            files[f"{name}.svg"] = artwork.painted(coloring.colors).encode
    files["colors.json"] = json_text(colors, "the colours").encode
    rows = io.StringIO()
    csv.writer(rows).writerows(table(colorings))
    files["residuals.csv"] = rows.getvalue().encode
    return files


def write(colorings: Sequence[Coloring], folder: str | PathLike[str], size: int = 1024) -> list[Path]:
    """Write the `contents` into a folder that exists.

    Returns
    -------
    list of Path
        The files.
    """
    files = contents(colorings, size)
    return [write_whole(Path(folder, name), content()) for name, content in files.items()]


def _png(image: Image.Image) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG", optimize=True)
    return out.getvalue()


def _shrunk(image: Image.Image, size: int) -> Image.Image:
    scale = size / max(image.size)
    return image.resize(
        (max(1, round(scale * image.width)), max(1, round(scale * image.height))), Image.Resampling.LANCZOS
    )
