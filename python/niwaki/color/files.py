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
    """All colourings on one page, numbered.

    Parameters
    ----------
    columns
        Pictures in a row.
    size
        Pixels of the longer side of each.
    """
    images = [one.image(2 * size).convert("RGBA") for one in colorings]
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
    """A row for each rule: its kind, its regions, its goal, and each colouring's residual, CIELAB units."""
    rows = [["rule", "first", "second", "wanted", *(f"{k + 1:02}" for k in range(len(colorings)))]]
    kept = [one.kept for one in colorings]
    for k, first in enumerate(kept[0]):
        misses = [f"{one[k].residual:.2f}" for one in kept]
        rows.append([first.rule.kind, first.rule.first, first.rule.second, f"{first.wanted:g}", *misses])
    return rows


def contents(colorings: Sequence[Coloring], size: int = 1024) -> dict[str, Callable[[], bytes]]:
    """The bytes of the files of colourings, by name: functions that give them. The first of each kind shows most.

    `sheet.png`; `01.png` and, for a drawing that is an SVG, `01.svg`, and so on; `colors.json`, the colours by file and
    region; `residuals.csv`, a row for each rule.
    """
    colors = {f"{k + 1:02}": one.colors for k, one in enumerate(colorings)}
    made: dict[str, Callable[[], bytes]] = {"sheet.png": lambda: _png(sheet(colorings))}
    for name, one in zip(colors, colorings, strict=True):
        made[f"{name}.png"] = lambda one=one: _png(one.image(size))  # type: ignore[misc]
        if (artwork := one.drawing.artwork) is not None:
            made[f"{name}.svg"] = artwork.painted(one.colors).encode
    made["colors.json"] = json_text(colors, "the colours").encode
    rows = io.StringIO()
    csv.writer(rows).writerows(table(colorings))
    made["residuals.csv"] = rows.getvalue().encode
    return made


def write(colorings: Sequence[Coloring], folder: str | PathLike[str], size: int = 1024) -> list[Path]:
    """Write the `contents` to a folder that is there.

    Returns
    -------
    list of Path
        What was written.
    """
    made = contents(colorings, size)
    return [write_whole(Path(folder, name), content()) for name, content in made.items()]


def _png(image: Image.Image) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG", optimize=True)
    return out.getvalue()


def _shrunk(image: Image.Image, size: int) -> Image.Image:
    scale = size / max(image.size)
    return image.resize(
        (max(1, round(scale * image.width)), max(1, round(scale * image.height))), Image.Resampling.LANCZOS
    )
