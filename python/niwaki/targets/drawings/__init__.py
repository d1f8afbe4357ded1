"""Drawings of our own to grow into, by name: `scribbles/012`, `glyphs/lobster-B`, `letters/E`, `silhouettes/cat`.

scribbles     strokes of a brush, made by code; all start at the same point
glyphs        letters, figures and signs of script fonts, in one piece without enclosed paper
letters       capitals and figures of a plain bold font
silhouettes   animals and plants, from clip art in the public domain

Each is 50 by 50 pixels. `table.csv` has a line for each: its cell on the collection's page, where a model starts
(shares of the image from its lower left corner) and in which direction, and its use: "training", or "held-out" for
what no guide is trained on. `benches/drawings/make.py` made them; NOTICE has the licences.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from niwaki.errors import InputError
from niwaki.targets.drawing import Drawing, Point

#: Pixels along a side of each drawing, and drawings in a row of a page.
SIDE, ACROSS = 50, 16

COLLECTIONS = ("scribbles", "glyphs", "letters", "silhouettes")

_HERE = Path(__file__).parent


@dataclass(frozen=True)
class Row:
    """A line of the table."""

    name: str
    cell: int
    start: Point
    ahead: Point
    use: str


@cache
def table() -> dict[str, Row]:
    """Every drawing by its name."""
    with (_HERE / "table.csv").open(encoding="utf-8", newline="") as file:
        rows = [
            Row(
                row["name"],
                int(row["cell"]),
                (float(row["x"]), float(row["y"])),
                (float(row["ahead_x"]), float(row["ahead_y"])),
                row["use"],
            )
            for row in csv.DictReader(file)
        ]
    return {row.name: row for row in rows}


def names(collection: str | None = None, use: str | None = None) -> list[str]:
    """The names of a collection's drawings, or of all, with that use ("training" or "held-out"), or any."""
    return [
        row.name
        for row in table().values()
        if collection in (None, row.name.partition("/")[0]) and use in (None, row.use)
    ]


def drawing(name: str) -> Drawing:
    """The drawing of that name."""
    row = table().get(name)
    if row is None:
        alike = [known for known in table() if known.lower() == name.lower()]
        near = alike or get_close_matches(name, table(), n=1, cutoff=0.3)
        raise InputError("unknown-drawing", name=name, near=near[0] if near else "letters/E")
    down, across = divmod(row.cell, ACROSS)
    page = _page(name.partition("/")[0])
    greys = page[down * SIDE : (down + 1) * SIDE, across * SIDE : (across + 1) * SIDE]
    return Drawing(name, np.ascontiguousarray(greys), row.start, row.ahead)


def find(place: str, pixels: int = SIDE) -> Drawing:
    """A drawing by name or by file; a name is used where no such file exists.

    Parameters
    ----------
    place
        `letters/E`, or an image file.
    pixels
        Of the longer side of a file's image: a larger one is made smaller.
    """
    collection = place.partition("/")[0]
    if not Path(place).exists() and (place in table() or collection in COLLECTIONS):
        return drawing(place)
    return Drawing.load(place, pixels)


@cache
def _page(collection: str) -> NDArray[np.uint8]:
    with Image.open(_HERE / f"{collection}.png") as image:
        return np.asarray(image.convert("L"))
