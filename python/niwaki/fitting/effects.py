"""A picture of what parameters move: for each a bar, and the parts of the target that change, seen from the front."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw, ImageFont

if TYPE_CHECKING:
    from niwaki.fitting.answers import Effect

#: The most parameters of a picture, and the height of a caption, pixels.
MOST, CAPTION = 24, 34
#: Linear ramps of the colours from no change: to fewer cells, and to more.
PAPER, LESS, MORE, INK = (250, 249, 246), (178, 58, 42), (32, 92, 140), (40, 40, 40)


def drawn(effects: Sequence[Effect], size: int = 160) -> Image.Image:
    """Draw the strongest effects; blue parts gain cells when the parameter grows, red parts lose them."""
    shown = list(effects[:MOST])
    columns = min(6, max(1, len(shown)))
    rows = max(1, -(-len(shown) // columns))
    page = Image.new("RGB", (columns * size, rows * (size + CAPTION)), PAPER)
    pen, font = ImageDraw.Draw(page), ImageFont.load_default(13)
    largest = max((effect.size for effect in shown), default=1.0) or 1.0
    for place, effect in enumerate(shown):
        left, top = place % columns * size, place // columns * (size + CAPTION)
        if effect.blocks is not None:
            page.paste(_map(effect.blocks, size - 12), (left + 6, top + 6))
        pen.text((left + 8, top + size - 2), effect.name, INK, font)
        bar = (size - 16) * effect.size / largest
        pen.rectangle((left + 8, top + size + 18, left + 8 + bar, top + size + 24), fill=INK)
    return page


def _map(blocks: np.ndarray, size: int) -> Image.Image:
    """Blocks (x, y, z) summed along z, as seen from the front."""
    gain, loss = np.maximum(blocks, 0).sum(2), np.maximum(-blocks, 0).sum(2)
    peak = max(float(gain.max()), float(loss.max()), 1e-9)
    # Rows from the top: y falls.
    gain, loss = gain.T[::-1] / peak, loss.T[::-1] / peak
    paper, less, more = (np.array(color, float) for color in (PAPER, LESS, MORE))
    both = np.maximum(gain + loss, 1e-9)[..., None]
    hue = (gain[..., None] * more + loss[..., None] * less) / both
    mix = np.maximum(gain, loss)[..., None]
    pixels = np.round(paper + (hue - paper) * np.sqrt(mix)).astype(np.uint8)
    rows, columns = pixels.shape[:2]
    step = max(1, size // max(rows, columns))
    image = Image.fromarray(pixels).resize((columns * step, rows * step), Image.Resampling.NEAREST)
    out = Image.new("RGB", (size, size), PAPER)
    out.paste(image, ((size - image.width) // 2, (size - image.height) // 2))
    return out
