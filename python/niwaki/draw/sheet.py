"""Sheets: several pictures on one page, each with a small caption, to compare results.

All pictures have the same framing, so that a larger scene looks larger.
"""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from PIL import Image, ImageDraw, ImageFont

from niwaki import _engine
from niwaki.draw.assembly import Assembly, Volume
from niwaki.draw.limits import check_size
from niwaki.draw.picture import BACKDROPS, picture, save_image
from niwaki.errors import FileError
from niwaki.errors.settings import count


def sheet(
    scenes: Sequence[Assembly],
    captions: Sequence[str] | None = None,
    target: Volume | None = None,
    *,
    columns: int | None = None,
    size: tuple[int, int] = (480, 360),
    ghost: bool = True,
    **settings: Any,
) -> Image.Image:
    """Draw scenes side by side.

    Parameters
    ----------
    scenes
        The scenes, in reading order.
    captions
        A line of text for each scene; no captions when left out.
    target
        The target to draw as a ghost in each picture; if `ghost` is false, it only affects the framing.
    columns
        The number of pictures in a row; when left out, the page is as square as possible.
    size
        Width and height of each picture in pixels.
    settings
        As for `niwaki.draw.picture.picture`.
    """
    if not scenes:
        raise FileError("scene-empty", verb="draw")
    if captions is not None and len(captions) != len(scenes):
        raise FileError(
            "setting", name="captions", found=len(captions), expected=f"one for each of {len(scenes)} scenes"
        )
    if columns is not None:
        count("columns", columns)
    across = min(columns or _columns(len(scenes)), len(scenes))
    down = -(-len(scenes) // across)
    width, height = size
    check_size(size, across * down)
    letters = max(11, round(height / 22))
    font = ImageFont.load_default(letters)
    texts = [_lines(caption, font, width - letters) for caption in captions or ()]
    rows = max(map(len, texts), default=0)
    strip = round(letters * (0.9 + 1.3 * rows)) if rows else 0
    gap = max(2, round(height / 120))
    backdrop = settings.get("backdrop", "studio")
    colors = BACKDROPS.get(backdrop)
    dark = backdrop == "slate"
    paper = (0, 0, 0, 0) if colors is None else (*(round(255 * c) for c in colors[1]), 255)
    line = (
        (0, 0, 0, 0)
        if colors is None
        else (*((c - 14 if dark else min(c + 14, 255)) for c in paper[:3]), 255)
    )
    page = Image.new("RGBA", (across * (width + gap) - gap, down * (height + strip + gap) - gap), line)
    pen = ImageDraw.Draw(page)
    whole = _together(scenes, target)
    for k, scene in enumerate(scenes):
        x, y = (k % across) * (width + gap), (k // across) * (height + strip + gap)
        image = picture(scene, target if ghost else None, size=size, frame=whole, **settings)
        page.paste(Image.new("RGBA", (width, height + strip), paper), (x, y))
        page.paste(image, (x, y))
        if captions:
            ink = (205, 207, 210, 255) if dark else (84, 82, 78, 255)
            for row, text in enumerate(texts[k]):
                middle = y + height + round(letters * 2.2) * 0.42 + letters * 1.3 * row
                pen.text((x + width / 2, middle), text, ink, font, anchor="mm")
    return page


def save(path: str | PathLike[str], scenes: Sequence[Assembly], *arguments: Any, **settings: Any) -> Path:
    """Draw a sheet into an image file; arguments and settings as for `sheet`."""
    return save_image(lambda: sheet(scenes, *arguments, **settings), path)


def _columns(count: int) -> int:
    """Find the smallest number of columns that is at least the number of rows."""
    across = 1
    while across * across < count:
        across += 1
    return across


def _together(scenes: Sequence[Assembly], target: Volume | None) -> Assembly:
    """Collect all parts in a scene, for the framing."""
    parts = [(f"{k}", [shape for part in scene for shape in part.shapes]) for k, scene in enumerate(scenes)]
    if target is not None:
        parts.append(("target", [_engine.shape("mesh", target.vertices, target.faces)]))
    return Assembly(parts)


def _lines(text: str, font: Any, width: float) -> list[str]:
    """Break a caption that is too long into two lines; a line that is still too long is shortened."""
    words = text.split()
    if font.getlength(text) <= width or len(words) < 2:
        return [_fit(text, font, width)]
    halves = [(" ".join(words[:k]), " ".join(words[k:])) for k in range(1, len(words))]
    return [_fit(half, font, width) for half in min(halves, key=lambda half: max(map(font.getlength, half)))]


def _fit(text: str, font: Any, width: float) -> str:
    """Shorten a text with dots until it fits."""
    if font.getlength(text) <= width:
        return text
    while text and font.getlength(text + "...") > width:
        text = text[:-1]
    return text.rstrip() + "..."
