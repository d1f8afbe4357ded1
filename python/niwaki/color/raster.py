"""An SVG as pixels, drawn by resvg.

resvg has no limits of time and memory. The size of a drawing of plain shapes bounds its cost, so it is drawn at once. A
drawing with filters, patterns, masks, markers, dashes or pictures is drawn in a separate process.
"""

from __future__ import annotations

import io
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from niwaki.draw.limits import check_size
from niwaki.errors import FileError
from niwaki.errors.extras import optional
from niwaki.inputs import library, limit, read_apart

_COSTLY = re.compile(
    r"<(?:\w+:)?(?:use|clipPath|filter|image|marker|mask|pattern|textPath)\b|dasharray|filter\s*:(?!\s*none)"
)


def raster(text: str, size: int, place: str | Path | None = None) -> Image.Image:
    """Draw an SVG with resvg; its longer side has `size` pixels.

    Raises
    ------
    FileError
        resvg is not installed, cannot read the drawing, or needs too much time or memory.
    InputError
        `bad-setting`: the size is not from 1 to 16,384, or needs too much memory.
    """
    check_size((size, size))
    optional("resvg_py", "drawing SVG files", "color")
    data = text.encode()
    if len(data) <= limit("apart") and not _COSTLY.search(text):
        try:
            pixels = drawn(data, size)["pixels"]
        except FileError as error:
            error.place = place
            raise
    else:
        # The 40 bytes of a pixel are those of a few layers.
        memory = limit("memory") + 40 * size * size
        pixels = read_apart(drawn, data, place, ".svg", memory, size=size)["pixels"]
    return Image.fromarray(pixels, "RGBA")


def drawn(data: bytes, size: int) -> dict[str, NDArray[Any]]:
    """Draw the pixels of an SVG, (rows, columns, 4) uint8: red, green, blue, alpha."""
    resvg_py = optional("resvg_py", "drawing SVG files", "color")
    text = data.decode()
    with library(None, ".svg"):
        # To read the system's fonts takes longer than to draw.
        plain = "<text" not in text
        image = _open(
            resvg_py.svg_to_bytes(svg_string=text, width=size, height=size, skip_system_fonts=plain)
        )
        if image.height > size:
            image = _open(resvg_py.svg_to_bytes(svg_string=text, height=size, skip_system_fonts=plain))
    return {"pixels": np.asarray(image)}


def _open(data: bytes) -> Image.Image:
    # resvg draws the size that `drawn` asked for, so Pillow's limit on pixels does not matter.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        return Image.open(io.BytesIO(bytes(data)), formats=["PNG"]).convert("RGBA")
