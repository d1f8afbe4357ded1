"""Images that are made from seeds: each is a table of named masks, (rows, columns) bool, whose union is the image."""

from __future__ import annotations

import numpy as np
from niwaki.targets.examples.lofts import curve
from PIL import Image, ImageDraw

from searches.measures import Mask

#: Rows and columns of skylines, and scene units of a row.
SKYLINE = (96, 128)
HEIGHT = 15.0


def skyline(random: np.random.Generator) -> dict[str, Mask]:
    """Five towers side by side, of very different heights, one of them above x = 0; the ground is the lowest row."""
    rows, columns = SKYLINE
    scale = rows / HEIGHT
    widths = random.uniform(2.4, 3.6, 5)
    edges = np.concatenate([[0.0], np.cumsum(widths)])
    edges -= edges[random.integers(1, 4)] + random.uniform(0.3, 0.7) * widths[0]
    heights = {}
    for k, (low, high) in enumerate(zip(edges[:-1], edges[1:], strict=True)):
        mask = np.zeros(SKYLINE, dtype=bool)
        first, last = (round(columns / 2 + scale * x) for x in (low, high))
        mask[rows - round(scale * random.uniform(2.5, 11.5)) :, max(first, 0) : last] = True
        heights[f"tower {k + 1}"] = mask
    return heights


def stroke(random: np.random.Generator, side: int = 96, thick: int = 9) -> dict[str, Mask]:
    """A thick curve across a square, in two halves."""
    turn = random.uniform(0.0, 2.0 * np.pi)
    across = np.linspace(-0.36, 0.36, 5)
    aside = random.uniform(-0.24, 0.24, 5)
    points = np.stack(
        [
            0.5 + across * np.cos(turn) - aside * np.sin(turn),
            0.5 + across * np.sin(turn) + aside * np.cos(turn),
        ],
        axis=1,
    )
    line = side * curve(points, 8)
    halves = {"first": line[: len(line) // 2 + 1], "second": line[len(line) // 2 :]}
    return {f"{name} half": drawn(half, side, thick) for name, half in halves.items()}


def drawn(line: np.ndarray, side: int, thick: int) -> Mask:
    """A line of points (n, 2) with round ends."""
    image = Image.new("L", (side, side))
    pen, radius = ImageDraw.Draw(image), 0.5 * thick
    for x, y in line:
        pen.ellipse((x - radius, y - radius, x + radius, y + radius), fill=255)
    pen.line([tuple(point) for point in line], fill=255, width=thick)
    return np.asarray(image) > 127
