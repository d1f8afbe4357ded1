"""Guides beside hard constraints (dissertation 6.6): vines that must not touch stones.

    python benches/obstacles.py [FOLDER]

Three stones lie on each drawing. A branch that comes near one makes the run impossible. Four searches grow the vines:
without a guide; by the package's guide of vines, which knows no stones; by a guide that was trained with stones which
it cannot see; and by one that can, because the nearest stone is a variable of the model. Writes `obstacles.json` and a
sheet of drawings.
"""

from __future__ import annotations

import json
import sys
import time
from math import cos, hypot, pi, sin
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import condition, flip, gaussian, look, model
from niwaki.draw.flat.drawing import drawing as draw_flat
from niwaki.gallery.vines import BETWEEN, LENGTH, STEM, THINNER, THINNEST, WIDTH, WINDOW
from niwaki.targets import drawings
from niwaki.targets.drawing import Drawing
from PIL import Image, ImageChops, ImageDraw

#: Radius of a stone with what must stay free around it, and how far the first is from the start, units.
STONE, APART = 1.4, 5.0
STONES = 3
SEEDS = range(5)
#: Pixels along a side of a picture.
SIDE = 200


def gap(stones, x, y):
    """The way from (x, y) to the middle of the nearest stone, as (dx, dy)."""
    best = (99.0, 99.0)
    for stone in stones:
        away = (stone[0] - x, stone[1] - y)
        if away[0] * away[0] + away[1] * away[1] < best[0] * best[0] + best[1] * best[1]:
            best = away
    return best


def free(stones, x, y):
    """Whether no stone is at (x, y)."""
    away = gap(stones, x, y)
    return away[0] * away[0] + away[1] * away[1] > STONE * STONE


@model
def vines(x, y, ahead, stones, sees):
    """Vines without leaves. Where it `sees`, the nearest stone is a variable, which a guide can read."""
    look((x, y), ahead)
    angle = gaussian(pi / 2.0, pi / 6.0)
    branch(x, y, angle, WIDTH, stones, sees)


@model
def branch(x, y, angle, width, stones, sees):
    """One stroke, and those that follow; whether the vine is still alive."""
    look((x, y), (cos(angle), sin(angle)))
    away = gap(stones, x, y) if sees else (0.0, 0.0)
    # Along the stroke, and across it.
    near = (away[0] * cos(angle) + away[1] * sin(angle), away[1] * cos(angle) - away[0] * sin(angle))  # noqa: F841
    angle = angle + gaussian(0.0, pi / 8.0)
    width = THINNER * width
    end_x, end_y = x + LENGTH * cos(angle), y + LENGTH * sin(angle)
    condition(free(stones, end_x, end_y))
    condition(free(stones, 0.5 * (x + end_x), 0.5 * (y + end_y)))
    nw.emit(nw.stroke((x, y, BETWEEN), (end_x, end_y, BETWEEN), width, color=STEM))
    look((end_x, end_y), (cos(angle), sin(angle)))
    alive = not flip(0.5)
    if alive and width > THINNEST:
        first = flip(0.66)
        if first:
            alive = branch(end_x, end_y, angle, width, stones, sees)
        if alive:
            second = flip(0.5)
            if second:
                alive = branch(end_x, end_y, angle, width, stones, sees)
    return alive


def stones_of(drawing: Drawing) -> list[tuple[float, float]]:
    """Stones on a drawing's ink, apart from the start and from each other; by its name always the same."""
    draw = np.random.default_rng(sum(map(ord, drawing.name)))
    (left, low), (right, high) = WINDOW
    rows, columns = drawing.greys.shape
    inked = np.argwhere(drawing.greys < 255)
    x, y, _ = drawing.place(WINDOW)
    chosen = [(x, y)]
    for row, column in inked[draw.permutation(len(inked))]:
        at = (left + (column + 0.5) / columns * (right - left), high - (row + 0.5) / rows * (high - low))
        if all(hypot(at[0] - a, at[1] - b) > APART for a, b in chosen):
            chosen.append((float(at[0]), float(at[1])))
        if len(chosen) > STONES:
            break
    return chosen[1:]


def arguments(drawing: Drawing, sees: bool, stony: bool = True) -> tuple[Any, ...]:
    """The arguments of the model."""
    return (*drawing.place(WINDOW), stones_of(drawing) if stony else [], sees)


def trained(learned: list[Drawing], judged: list[Drawing], sees: bool, stony: bool) -> nw.Guide:
    """A guide that learned with stones, or without."""
    return nw.train_guide(
        vines,
        learned,
        lambda page: page.score(WINDOW),
        lambda page: arguments(page, sees, stony),
        held_out=judged,
        rounds=(100, 200),
        keep=lambda sample: sample.has_ended and sample.primitives >= 8,
        seed=1,
    )


def measured(
    judged: list[Drawing], sees: bool, method: nw.methods.Smc
) -> tuple[dict[str, float], list[nw.Sample | None]]:
    """Similarities of the best runs, searches that lost every particle, the time; and the results of the first seed."""
    alike: list[float] = []
    first: list[nw.Sample | None] = []
    lost = 0
    cpu = time.process_time()
    for seed in SEEDS:
        for page in judged:
            search = nw.Search(
                vines, arguments(page, sees), score=page.score(WINDOW), method=method, seed=seed
            )
            best = None
            try:
                best = search.run(threads=1).best
            except nw.InputError:
                lost += 1
            alike.append(0.0 if best is None else best.similarity or 0.0)
            if seed == SEEDS[0]:
                first.append(best)
    count = len(SEEDS) * len(judged)
    return {
        "mean": float(np.mean(alike)),
        "median": float(np.median(alike)),
        "p10": float(np.quantile(alike, 0.1)),
        "stumps": float(np.mean(np.array(alike) < 0.1)),
        "lost": lost / count,
        "ms": 1000 * (time.process_time() - cpu) / count,
    }, first


def main(folder: Path) -> None:
    """Train, measure, draw."""
    training = [drawings.drawing(name) for name in drawings.names("scribbles", "training")]
    judged = [page for i, page in enumerate(training) if i % 8 == 0]
    learned = [page for i, page in enumerate(training) if i % 8]
    clear, unseen = trained(learned, judged, False, False), trained(learned, judged, False, True)
    seen = trained(learned, judged, True, True)
    table: dict[str, Any] = {}
    pictures = []
    for name, sees, guide, particles in (
        ("no guide, 20", False, None, 20),
        ("no guide, 300", False, None, 300),
        ("trained without stones, 20", False, clear, 20),
        ("trained with stones unseen, 20", False, unseen, 20),
        ("sees the nearest stone, 20", True, seen, 20),
        ("trained without stones, 100", False, clear, 100),
        ("trained with stones unseen, 100", False, unseen, 100),
        ("sees the nearest stone, 100", True, seen, 100),
    ):
        method = nw.smc(particles, resampling="tempered", guide=guide)
        table[name], samples = measured(judged, sees, method)
        pictures.append(samples)
        print(name, {key: round(value, 3) for key, value in table[name].items()}, flush=True)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "obstacles.json").write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    rows, columns = len(pictures[5:]), 6
    sheet = Image.new("RGB", (columns * SIDE, rows * SIDE), "white")
    for row, samples in enumerate(pictures[5:]):
        for column, (sample, page) in enumerate(zip(samples[:columns], judged, strict=False)):
            sheet.paste(cell(sample, page), (column * SIDE, row * SIDE))
    sheet.save(folder / "obstacles.png", optimize=True)


def cell(sample: nw.Sample | None, target: Drawing) -> Image.Image:
    """A drawing in grey, its stones, and what grew; a cross where every particle was lost."""
    paper = np.where(target.greys[:, :, None] < 255, 225, 255).astype(np.uint8).repeat(3, axis=2)
    page = Image.fromarray(paper).resize((SIDE, SIDE), Image.Resampling.NEAREST)
    (left, low), (right, high) = WINDOW
    unit = SIDE / (right - left)
    brush = ImageDraw.Draw(page)
    for x, y in stones_of(target):
        middle = ((x - left) * unit, (high - y) * unit)
        brush.circle(middle, STONE * unit, fill=(150, 120, 110))
    if sample is None:
        brush.text((8, 8), "lost", fill=(160, 30, 30))
        return page
    grown = draw_flat(sample.scene, size=(SIDE, SIDE), style="ink", window=WINDOW)
    return ImageChops.multiply(page, grown.convert("RGB"))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("out/obstacles"))
