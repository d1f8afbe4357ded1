"""Built-in drawings to grow into, by name: `scribbles/012`, `glyphs/lobster-B`, `letters/E`, `silhouettes/cat`.

scribbles     strokes of a brush, made by code; all start at the same point
glyphs        letters, figures and signs of script fonts, in one piece without enclosed paper
letters       capitals and figures of a plain bold font
silhouettes   animals and plants, from clip art in the public domain

A drawing is 50 by 50 pixels. `table.csv` has a line for each: its cell on the collection's page, where a model starts
(shares of the image from its lower left corner) and in which direction, and its use: "training", or "held-out" for
drawings that no guide is trained on. `benches/drawings/make.py` made them; NOTICE has the licences.
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

#: The number of pixels along a side of a drawing, and of drawings in a row of a page.
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
    """Return the rows of the table by the names of their drawings."""
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
    """Return the names of all drawings, or of those of a collection or a use ("training" or "held-out")."""
    return [
        row.name
        for row in table().values()
        if collection in (None, row.name.partition("/")[0]) and use in (None, row.use)
    ]


def drawing(name: str) -> Drawing:
    """Return the drawing of that name."""
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
    """Find a drawing by name or by file. A file of the same name comes first.

    Parameters
    ----------
    place
        `letters/E`, or an image file.
    pixels
        Pixels of the longer side of a file's image: a larger image is made smaller.
    """
    collection = place.partition("/")[0]
    if not Path(place).exists() and (place in table() or collection in COLLECTIONS):
        return drawing(place)
    return Drawing.load(place, pixels)


@cache
def _page(collection: str) -> NDArray[np.uint8]:
    with Image.open(_HERE / f"{collection}.png") as image:
        return np.asarray(image.convert("L"))
