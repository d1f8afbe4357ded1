"""Small pictures for clients that show no meshes: PNGs of at most 100 kB."""

from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any

from PIL import Image

from niwaki.result import Sample

#: The most bytes of a picture.
MOST = 100_000
#: Sizes in pixels, tried in this order until a picture is small enough; rays for each pixel at edges.
SIZES, SAMPLES = ((480, 360), (320, 240), (160, 120)), 4
#: Colours of a picture.
COLORS = 96


def small(draw: Callable[[tuple[int, int]], Image.Image]) -> bytes:
    """Return a picture as a small PNG; `draw` draws it in a size."""
    data = b""
    for size in SIZES:
        sink = io.BytesIO()
        draw(size).convert("RGB").quantize(COLORS, dither=Image.Dither.NONE).save(sink, "PNG", optimize=True)
        data = sink.getvalue()
        if len(data) <= MOST:
            break
    return data


def result(sample: Sample, style: str | None) -> bytes:
    """Draw a result with its target."""
    styled: dict[str, Any] = {} if style is None else {"style": style}

    def draw(size: tuple[int, int]) -> Image.Image:
        picture: Image.Image = sample.picture(size=size, samples=SAMPLES, **styled)
        return picture

    return small(draw)
