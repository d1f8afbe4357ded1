"""A picture of what parameters move: for each a bar, and the parts of the target that change, seen from the front."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

if TYPE_CHECKING:
    from niwaki.fitting.answers import Effect

    Font = ImageFont.FreeTypeFont | ImageFont.ImageFont

#: The most parameters of a picture; the height of a caption and of the last line, pixels; columns.
MOST, CAPTION, LEGEND, COLUMNS = 24, 40, 26, 6
#: Linear ramps of the colours from no change: to fewer cells, and to more. The target is a shade behind them.
PAPER, LESS, MORE, INK, SHADE = (250, 249, 246), (178, 58, 42), (32, 92, 140), (40, 40, 40), (222, 220, 214)
#: A change below this share of the largest of its parameter is not drawn: an emulator is not sure of it.
LEAST = 0.15


def drawn(effects: Sequence[Effect], body: NDArray[np.float64] | None = None, size: int = 160) -> Image.Image:
    """Draw the strongest effects; blue parts gain cells when the parameter grows, red parts lose them.

    Parameters
    ----------
    effects
        The effects, the strongest first.
    body
        Cells of the target in each block (x, y, z), for a shade behind the changes.
    size
        The side of a map, pixels.
    """
    shown = list(effects[:MOST])
    columns = min(COLUMNS, max(1, len(shown)))
    rows = max(1, -(-len(shown) // columns))
    page = Image.new("RGB", (columns * size, rows * (size + CAPTION) + LEGEND), PAPER)
    pen, font = ImageDraw.Draw(page), ImageFont.load_default(12)
    largest = max((effect.size for effect in shown), default=1.0) or 1.0
    # One scale for all maps: a weak parameter is pale.
    peaks = [_peak(effect.blocks) for effect in shown if effect.blocks is not None]
    peak = max(peaks, default=1.0)
    for place, effect in enumerate(shown):
        left, top = place % columns * size, place // columns * (size + CAPTION)
        if effect.blocks is not None:
            page.paste(_map(effect.blocks, body, peak, size - 12), (left + 6, top + 6))
        pen.text((left + 8, top + size), _fitting(str(effect), pen, font, size - 14), INK, font)
        bar = (size - 16) * effect.size / largest
        pen.rectangle((left + 8, top + size + 20, left + 8 + bar, top + size + 26), fill=INK)
    if peaks:
        top = rows * (size + CAPTION) + 2
        for left, color, text in ((8, MORE, "gains"), (78, LESS, "loses"), (148, SHADE, "target")):
            pen.rectangle((left, top + 3, left + 11, top + 14), fill=color)
            pen.text((left + 17, top), text, INK, font)
    return page


def _peak(blocks: NDArray[np.float64]) -> float:
    """The largest gain or loss of a block as it is drawn."""
    return max(float(np.maximum(blocks, 0).sum(2).max()), float(np.maximum(-blocks, 0).sum(2).max()), 1e-9)


def _map(
    blocks: NDArray[np.float64], body: NDArray[np.float64] | None, peak: float, size: int
) -> Image.Image:
    """Blocks (x, y, z) summed along z, as seen from the front."""
    top = _peak(blocks)
    gain, loss = np.maximum(blocks, 0).sum(2), np.maximum(-blocks, 0).sum(2)
    # Rows from the top: y falls.
    gain, loss = (np.where(part < LEAST * top, 0.0, part).T[::-1] / peak for part in (gain, loss))
    paper, less, more, shade = (np.array(color, float) for color in (PAPER, LESS, MORE, SHADE))
    behind = np.broadcast_to(paper, (*gain.shape, 3))
    if body is not None:
        filled = body.sum(2).T[::-1]
        share = np.minimum(filled / max(float(filled.max()), 1e-9) * 2.0, 1.0)[..., None]
        behind = paper + (shade - paper) * share
    both = np.maximum(gain + loss, 1e-9)[..., None]
    hue = (gain[..., None] * more + loss[..., None] * less) / both
    mix = np.sqrt(np.clip(np.maximum(gain, loss), 0.0, 1.0))[..., None]
    pixels = np.round(behind + (hue - behind) * mix).astype(np.uint8)
    rows, columns = pixels.shape[:2]
    step = max(1, size // max(rows, columns))
    image = Image.fromarray(pixels).resize((columns * step, rows * step), Image.Resampling.NEAREST)
    out = Image.new("RGB", (size, size), PAPER)
    out.paste(image, ((size - image.width) // 2, (size - image.height) // 2))
    return out


def _fitting(text: str, pen: ImageDraw.ImageDraw, font: Font, width: int) -> str:
    """Shorten a text until it is as wide as its place."""
    if pen.textlength(text, font) <= width:
        return text
    while text and pen.textlength(text + "…", font) > width:
        text = text[:-1]
    return text + "…"
