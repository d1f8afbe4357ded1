"""Animations of the studio's page for the manual: frames with the pointer, and with a line of text below."""

from __future__ import annotations

import io
from pathlib import Path
from typing import NamedTuple

from PIL import Image, ImageDraw, ImageFont


class Clip(NamedTuple):
    """A piece of the page, pixels of the page, and its size in a frame."""

    left: float
    top: float
    width: float
    height: float
    size: tuple[int, int]


def frame(page, clip: Clip, pointer: tuple[float, float] | None = None, caption: str = "") -> Image.Image:
    """Take a frame; a caption has a strip of its own below the page."""
    region = {"x": clip.left, "y": clip.top, "width": clip.width, "height": clip.height}
    with Image.open(io.BytesIO(page.screenshot(clip=region))) as shot:
        picture = shot.convert("RGB").resize(clip.size, Image.Resampling.LANCZOS)
    if pointer is not None:
        x, y = (
            (at - start) * side / length
            for at, start, side, length in zip(pointer, clip[:2], clip.size, clip[2:4], strict=True)
        )
        pen = ImageDraw.Draw(picture)
        pen.ellipse((x - 7, y - 7, x + 7, y + 7), outline=(255, 255, 255), width=4)
        pen.ellipse((x - 6, y - 6, x + 6, y + 6), outline=(30, 30, 34), width=2)
    if not caption:
        return picture
    font = ImageFont.load_default(15)
    whole = Image.new("RGB", (clip.size[0], clip.size[1] + 28), (48, 46, 42))
    whole.paste(picture, (0, 0))
    ImageDraw.Draw(whole).text((12, clip.size[1] + 5), caption, (243, 241, 236), font)
    return whole


def write(frames: list[Image.Image], durations: list[int], place: Path, colors: int) -> None:
    """Write an animation that repeats; durations are milliseconds.

    All frames have the same colours, so that only what changes is stored.
    """
    wide, high = frames[0].size
    some = frames[:: max(len(frames) // 12, 1)]
    sheet = Image.new("RGB", (wide, high * len(some)))
    for number, image in enumerate(some):
        sheet.paste(image, (0, high * number))
    palette = sheet.quantize(colors, dither=Image.Dither.NONE)
    first, *rest = [image.quantize(colors, palette=palette, dither=Image.Dither.NONE) for image in frames]
    place.parent.mkdir(parents=True, exist_ok=True)
    first.save(
        place, save_all=True, append_images=rest, duration=durations, loop=0, optimize=True, disposal=1
    )
