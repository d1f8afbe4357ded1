"""Glyphs of fonts and silhouettes of clip art, as small drawings in one piece."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

#: Pixels of an em, least ink in pixels, empty border, pixels of the final image.
EM, LEAST, EDGE, SMALL = 96, 500, 2, 50

#: Letters and figures first: where there are too many, the last are left out.
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
OTHER_CHARACTERS = "&$¢£¥€§?!ÆŒØÇçßæœøłŁđĦħ¶†@#%ΓΔΛΞΠΣΦΨΩµπ∂√∞∫ﬁﬂ{}"


def glyphs(font: Path, characters: str) -> dict[str, NDArray[np.uint8]]:
    """The glyphs in one piece without enclosed paper, (50, 50) with 255 for paper, by character."""
    face = ImageFont.truetype(str(font), EM * 4)
    missing = _ink(face, "\ue123")
    images: dict[str, NDArray[np.uint8]] = {}
    for character in characters:
        ink = _ink(face, character)
        if ink is None or (missing is not None and ink.shape == missing.shape and (ink == missing).all()):
            continue
        if ink.sum() < LEAST * 16 or ndimage.label(ink, np.ones((3, 3)))[1] != 1:
            continue
        if ndimage.label(~np.pad(ink, 1))[1] == 1:
            images[character] = squared(ink)
    return images


def letters(font: Path, characters: str) -> dict[str, NDArray[np.uint8]]:
    """Glyphs, with or without enclosed paper, by character."""
    face = ImageFont.truetype(str(font), EM * 4)
    inks = {character: _ink(face, character) for character in characters}
    return {character: squared(ink) for character, ink in inks.items() if ink is not None}


def _ink(face: ImageFont.FreeTypeFont, character: str) -> NDArray[np.bool_] | None:
    left, top, right, bottom = (round(side) for side in face.getbbox(character))
    if right <= left or bottom <= top:
        return None
    image = Image.new("L", (right - left + 8, bottom - top + 8))
    ImageDraw.Draw(image).text((4 - left, 4 - top), character, fill=255, font=face)
    ink = np.asarray(image) >= 128
    return _cropped(ink) if ink.any() else None


def _cropped(ink: NDArray[np.bool_]) -> NDArray[np.bool_]:
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    return ink[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def squared(ink: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """The shape in the middle of a square with a border, in the final size."""
    tall, wide = ink.shape
    inner = SMALL - 2 * EDGE
    scale = inner / max(tall, wide)
    size = max(1, round(wide * scale)), max(1, round(tall * scale))
    share = Image.fromarray(np.where(ink, np.uint8(255), np.uint8(0))).resize(size, Image.Resampling.BOX)
    page = Image.new("L", (SMALL, SMALL))
    page.paste(share, ((SMALL - size[0]) // 2, (SMALL - size[1]) // 2))
    return 255 - np.asarray(page)


def silhouette(svg: Path) -> NDArray[np.uint8] | None:
    """The shape of a clip art, when it is nearly in one piece and neither thin nor full; None otherwise."""
    import resvg_py

    try:
        png = bytes(resvg_py.svg_to_bytes(svg_path=str(svg), width=400))
        alpha = np.asarray(Image.open(io.BytesIO(png)).convert("RGBA"))[:, :, 3] >= 128
    except (ValueError, OSError):
        return None
    if not alpha.any() or max(alpha.shape) > 2000:
        return None
    labels, count = ndimage.label(_cropped(alpha), np.ones((3, 3)))
    sizes = np.bincount(labels.ravel())[1:]
    ink = ndimage.binary_fill_holes(labels == 1 + int(sizes.argmax()))
    tall, wide = ink.shape
    fill = ink.sum() / max(tall, wide) ** 2
    if sizes.max() < 0.97 * sizes.sum() or not 0.12 <= fill <= 0.6:
        return None
    return squared(ink)
