"""Drawings with what was grown into them, as cells of sheets."""

from collections.abc import Sequence
from types import ModuleType
from typing import Any

from niwaki.draw.flat.drawing import drawing
from niwaki.result import Sample
from niwaki.targets.drawing import Drawing
from pictures import LARGEST, written
from PIL import Image, ImageDraw, ImageFont
from places import Places

INK = (84, 82, 78)


def cell(model: ModuleType, page: Drawing, run: Sample | None, side: int) -> Image.Image:
    """A run over its drawing, pale; the drawing alone without one."""
    window = page.window(model.WINDOW)
    if run is None:
        return Image.fromarray(page.greys).convert("RGB").resize((side, side), Image.Resampling.BICUBIC)
    style: dict[str, Any] = {"style": model.DRAWS, "window": window, "under": page.greys < 255}
    return drawing(run.scene, size=(side, side), **style).convert("RGB")


def sheet(
    rows: Sequence[Sequence[Image.Image]],
    *,
    titles: Sequence[str] = (),
    below: Sequence[Sequence[str]] = (),
    gap: int = 4,
) -> Image.Image:
    """Cells in rows; titles above the columns, texts below the cells."""
    font, small = ImageFont.load_default(13), ImageFont.load_default(11)
    wide, tall = rows[0][0].size
    head, foot = (20 if titles else 0), (15 if below else 0)
    across = max(len(row) for row in rows)
    page = Image.new(
        "RGB", (across * (wide + gap) - gap, head + len(rows) * (tall + foot + gap) - gap), "white"
    )
    pen = ImageDraw.Draw(page)
    for column, title in enumerate(titles):
        pen.text((column * (wide + gap) + 0.5 * wide, 10), title, INK, font, anchor="mm")
    for number, row in enumerate(rows):
        top = head + number * (tall + foot + gap)
        for column, image in enumerate(row):
            page.paste(image, (column * (wide + gap), top))
            if below:
                middle = column * (wide + gap) + 0.5 * wide, top + tall + 8
                pen.text(middle, below[number][column], INK, small, anchor="mm")
    return page


def wrapped(cells: Sequence[Image.Image], across: int) -> list[Sequence[Image.Image]]:
    """Cells in rows of so many."""
    return [cells[i : i + across] for i in range(0, len(cells), across)]


def saved(places: Places, name: str, image: Image.Image) -> None:
    """Write a picture of less than `LARGEST` bytes, smaller where that is needed."""
    path = places.pictures / name
    while written(path, image).stat().st_size > LARGEST:
        image = image.resize((image.width * 9 // 10, image.height * 9 // 10), Image.Resampling.LANCZOS)
