"""The pictures of a result: the best run, a sheet of all runs, and the view of each image or shadow sketch."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import draw, targets
from niwaki.search import collisions
from niwaki.words.measures import worn

Quick = Annotated[
    bool,
    typer.Option(
        "--quick", help="Draw small pictures with one ray for each pixel, in some hundredths of a second."
    ),
]
PictureFlag = Annotated[
    bool,
    typer.Option("--picture/--no-picture", help="Draw best.png, sheet.png and the views that were matched."),
]

#: Sizes of a draft in pixels: the best, a cell of the sheet, and the height of a panel.
DRAFT, CELL, PANEL = (320, 240), (240, 180), 180


#: The picture of a run that breaks a constraint, and the colours of the parts that break it and of the rest.
IMPOSSIBLE = "impossible.png"
RED, GREY = (0.80, 0.15, 0.12), (0.80, 0.79, 0.77)


def impossible(search: nw.Search, folder: Path, quick: bool) -> str:
    """Draw a run that breaks a constraint, with the colliding parts in red; return a line about it, or nothing."""
    example = collisions.example(search)
    if example is None:
        return ""
    scene, broken = example
    parts = [
        (
            part.address,
            [
                worn(shape, {"color": RED if part.address in broken else GREY}, over=True)
                for shape in part.shapes
            ],
        )
        for part in scene.parts
    ]
    place = folder / IMPOSSIBLE
    draft: dict[str, Any] = {"size": DRAFT, "samples": 1} if quick else {"samples": 4}
    draw.picture.save_image(lambda: draw.picture.picture(draw.scene.Scene(parts), **draft), place)
    shown = ", ".join(search.model.labels.label(address) for address in broken[:3])
    more = f" and {len(broken) - 3} more" if len(broken) > 3 else ""
    return f"{place} shows such a run; the parts in red make it impossible: {shown}{more}"


@dataclass(frozen=True)
class Pictures:
    """Flags about pictures: whether to draw them, and whether as drafts."""

    wanted: PictureFlag = True
    quick: Quick = False

    def names(self, result: nw.Result, style: str | None) -> list[str]:
        """Return the names of the files; a single result has no sheet."""
        if not self.wanted:
            return []
        views = [f"{view.kind}.png" for view in result.score.views]
        return ["best.png", *(["sheet.png"] if len(result) > 1 else []), *views]

    def draft(self, result: nw.Result, folder: Path, style: str | None) -> None:
        """Draw the sheet and the best at once, with one ray for each pixel; a single picture needs no draft."""
        if "sheet.png" in self.names(result, style) and style is None and not self.quick:
            self._write(result, folder, style, {"samples": 1})

    def write(self, result: nw.Result, folder: Path, style: str | None) -> None:
        """Draw the pictures; `style` is the drawing style, None for scenes in space."""
        try:
            self._write(result, folder, style, {"samples": 1} if self.quick else {})
        except KeyboardInterrupt:
            if (folder / "best.png").exists():
                line = f"some pictures in {folder} are drafts; niwaki replay {folder / 'run.json'} draws them whole"
                print(line, file=sys.stderr)
            raise

    def _write(self, result: nw.Result, folder: Path, style: str | None, draft: dict[str, Any]) -> None:
        names = self.names(result, style)
        if not names:
            return
        self.best(result.best, folder / "best.png", style, draft)
        styled: dict[str, Any] = {} if style is None else {"style": style}
        if "sheet.png" in names:
            small: dict[str, Any] = (
                {"size": CELL} if self.quick and (result.score.target or not result.score.views) else {}
            )
            draw.picture.save_image(lambda: result.sheet(**styled, **draft, **small), folder / "sheet.png")
        high = {"height": PANEL} if self.quick else {}
        for view in result.score.views:
            place = folder / f"{view.kind}.png"
            targets.views.save_view(place, result.best.scene, view, **styled, **draft, **high)

    def best(
        self, sample: nw.Sample, place: Path, style: str | None, draft: dict[str, Any] | None = None
    ) -> Path:
        """Draw a run; `draft` has settings of a draft."""
        settings: dict[str, Any] = {} if style is None else {"style": style, "size": (800, 800)}
        settings |= draft or {}
        if self.quick:
            settings |= {"samples": 1, "size": DRAFT if style is None else (DRAFT[1], DRAFT[1])}
        return sample.save(place, **settings)
