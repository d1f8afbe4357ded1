"""Drawings: regions with names, the share of the picture that each takes, and neighbours.

Regions come from an SVG file (`niwaki.color.svg`) or from an image whose colours are the regions. Two regions are
neighbours if a pixel of the first lies within two pixels, across or diagonally, of a pixel of the second: thin lines
between areas do not part them. An area is the region's share of all pixels, including pixels of no region.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from niwaki.color.raster import raster
from niwaki.color.svg import Artwork
from niwaki.errors import FileError
from niwaki.inputs import bytes_of, regular
from niwaki.targets.pixels import load as load_pixels

NEAR = 2  # pixels
MOST_REGIONS = 256
EXAMPLES = Path(__file__).with_name("drawings")


class Drawing:
    """A picture divided into regions with names.

    Parameters
    ----------
    names
        Names of the regions.
    labels
        The region of each pixel, (height, width) int; -1 for none.
    artwork
        The SVG that was read, if any.
    place
        The file that was read, for messages.

    Attributes
    ----------
    areas : (regions,) float64
        Shares of the picture.
    pairs : list of (int, int)
        Neighbours, each once, the lower first.
    hidden : tuple of str
        Regions without a visible pixel.
    """

    def __init__(
        self,
        names: tuple[str, ...],
        labels: NDArray[np.int64],
        artwork: Artwork | None = None,
        place: str | Path | None = None,
    ) -> None:
        self.names, self.labels, self.artwork, self.place = names, labels, artwork, place
        count = np.bincount(labels[labels >= 0], minlength=len(names))
        self.areas: NDArray[np.float64] = count / labels.size
        self.pairs = neighbours(labels, len(names))
        self.hidden = tuple(name for name, pixels in zip(names, count, strict=True) if pixels == 0)

    @classmethod
    def load(cls, place: str | PathLike[str], size: int = 512) -> Drawing:
        """Load a drawing from a file, or a drawing of the package by name: robot, house, bug, rocket.

        Parameters
        ----------
        place
            An SVG file with a class or an id for each region, or an image whose colours are the regions.
        size
            Pixels of the longer side at which an SVG is measured.

        Raises
        ------
        FileError
            The file does not exist, cannot be read, or has fewer than two regions.
        """
        path = example_or_file(place, ".svg")
        regular(path)
        if path.suffix.lower() == ".svg":
            artwork = Artwork(bytes_of(path, "drawing"), path)
            if len(artwork.names) < 2:
                raise FileError("drawing-no-regions", path, found=_region_names(artwork.names))
            if len(artwork.names) > MOST_REGIONS:
                raise FileError("drawing-too-many", path, count=len(artwork.names), most=MOST_REGIONS)
            return cls(artwork.names, artwork.labels(size), artwork, path)
        return cls(*_of_image(path), None, path)

    @property
    def background(self) -> int | None:
        """The region that holds most of the outermost ring of pixels with regions; None if most of it has none.

        A frame, such as an ink line or a margin around the picture, has no region: then the rings inside of it are
        looked at.
        """
        height, width = self.labels.shape
        for inset in range(min(height, width) // 4):
            rows, columns = self.labels[inset : height - inset], self.labels[:, inset : width - inset]
            sides = rows[[0, -1], inset : width - inset], columns[inset : height - inset, [0, -1]]
            ring = np.concatenate([side.ravel() for side in sides])
            if (ring >= 0).any():
                count = np.bincount(ring + 1, minlength=len(self.names) + 1)
                most = int(count.argmax())
                return most - 1 if most > 0 else None
        return None

    def picture(self, colors: Mapping[str, str], size: int = 512) -> Image.Image:
        """Draw the picture in these colours, `#rrggbb` by region; the longer side of an SVG has `size` pixels."""
        if self.artwork is not None:
            return raster(self.artwork.painted(colors), size, self.place)
        table = np.zeros((len(self.names) + 1, 4), dtype=np.uint8)
        for k, name in enumerate(self.names):
            code = int(colors.get(name, name).removeprefix("#"), 16)
            table[k] = (code >> 16, code >> 8 & 255, code & 255, 255)
        return Image.fromarray(table[self.labels], "RGBA")

    def __repr__(self) -> str:
        height, width = self.labels.shape
        return (
            f"<Drawing: {len(self.names)} regions, {len(self.pairs)} pairs of neighbours, {width} x {height}>"
        )


def example_or_file(place: str | PathLike[str], suffix: str) -> Path:
    """Find a file by its path, or a file of the package by its name alone."""
    examples = {path.stem: path for path in EXAMPLES.glob(f"*{suffix}")}
    return Path(place) if os.path.exists(place) else examples.get(str(place), Path(place))


def neighbours(labels: NDArray[np.int64], count: int, near: int = NEAR) -> list[tuple[int, int]]:
    """List pairs of regions with pixels at most `near` rows and columns apart, the lower first, in order."""
    height, width = labels.shape
    codes: set[int] = set()
    for dy in range(min(near + 1, height)):
        for dx in range(-near, near + 1):
            if (dy == 0 and dx <= 0) or abs(dx) >= width:
                continue
            here = labels[: height - dy, max(0, -dx) : width - max(0, dx)]
            there = labels[dy:, max(0, dx) : width - max(0, -dx)]
            met = (here != there) & (here >= 0) & (there >= 0)
            low, high = np.minimum(here[met], there[met]), np.maximum(here[met], there[met])
            codes.update(np.unique(low * count + high).tolist())
    return [divmod(code, count) for code in sorted(codes)]


def _of_image(path: Path) -> tuple[tuple[str, ...], NDArray[np.int64]]:
    pixels = _rgba(load_pixels(path).channels)
    code = pixels[..., 0].astype(np.uint32) << 16
    code |= pixels[..., 1].astype(np.uint32) << 8
    code |= pixels[..., 2]
    opaque = pixels[..., 3] >= 128
    used = np.zeros(1 << 24, dtype=bool)
    used[code[opaque]] = True
    values = np.flatnonzero(used)
    if len(values) < 2:
        raise FileError("drawing-no-regions", path, found=f"{len(values)} opaque colour")
    if len(values) > MOST_REGIONS:
        raise FileError("drawing-too-many", path, count=len(values), most=MOST_REGIONS)
    numbers = np.zeros(1 << 24, dtype=np.int16)
    numbers[values] = np.arange(len(values))
    labels = np.where(opaque, numbers[code], np.int16(-1)).astype(np.int64)
    return tuple(f"#{value:06x}" for value in values.tolist()), labels


def _rgba(values: NDArray[Any]) -> NDArray[np.uint8]:
    """Convert the channels of an image to red, green, blue and alpha."""
    if values.dtype != np.uint8:
        values = np.rint(values.clip(0, 255)).astype(np.uint8)
    if values.ndim == 2:
        values = np.repeat(values[:, :, None], 3, axis=2)
    if values.shape[2] == 3:
        values = np.concatenate([values, np.full((*values.shape[:2], 1), 255, np.uint8)], axis=2)
    return values


def _region_names(names: tuple[str, ...]) -> str:
    return f"one region, `{names[0]}`" if names else "no painted shape with a class or an id"
