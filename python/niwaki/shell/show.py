"""`niwaki show`: runs of a model without a target, as a sheet."""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import replace
from typing import Annotated, Any

from PIL.Image import Image

import niwaki as nw
from niwaki import draw, methods, search, shell
from niwaki.draw.limits import PIXEL
from niwaki.draw.picture import IMAGE_FORMATS
from niwaki.errors import InputError
from niwaki.errors.memory import check_room
from niwaki.methods import Forward
from niwaki.shell import arguments, folders, pictures, reports
from niwaki.shell.app import Json, ModelName, Runs, Seed, app, counted
from niwaki.shell.clock import Clock

#: Most attempts for each run of the sheet; runs that break a constraint of the model are not shown.
TRIES = 50
#: Size of a cell of the sheet in pixels, and rays for each pixel where the picture changes.
CELL, SAMPLES = (320, 240), 4


@app.command()
def show(
    model: ModelName,
    values: arguments.Arguments = None,
    preset: arguments.Preset = None,
    runs: Runs = 6,
    seed: Seed = None,
    output: Annotated[str | None, folders.output("show.png")] = None,
    force: folders.Force = False,
    quick: pictures.Quick = False,
    as_json: Json = False,
) -> None:
    """Draw runs of MODEL side by side, without a target."""
    clock = Clock()
    cell = (CELL[0] // 2, CELL[1] // 2) if quick else CELL
    check_room("--runs", methods.at_least_one("--runs", runs), cell[0] * cell[1] * PIXEL, "picture")
    is_drawn = not as_json or output is not None
    suffixes = [suffix[1:] for suffix in IMAGE_FORMATS]
    place = folders.own_file(output, "show.png", suffixes, force) if is_drawn else None
    with clock.part("compile"):
        reference = shell.references.find(model)
        values_by_name = {**start(reference), **arguments.read(reference.model, values, preset)}
        reference.model.program()
    with clock.part("runs"):
        result = prior_runs(reference.model, values_by_name, runs, search.fresh(seed))
    described = report(result)
    if as_json:
        print(reports.as_json(described))
    else:
        for number, row in enumerate(described.runs, 1):
            print(f"#{number}   seed {row.seed}   {row.value or counted(row.primitives, 'primitive')}")
    if place is None:
        return
    if not any(sample.primitives for sample in result):
        print("no run emitted a shape, so there is no picture", file=sys.stderr if as_json else sys.stdout)
        return
    with clock.part("picture"):
        settings: dict[str, Any] = {"size": cell, "samples": 1 if quick else SAMPLES}
        draw.picture.save_image(lambda: sheet(reference, result, **settings), place)
    if not as_json:
        print(f"{place}   {clock}")


def report(result: nw.Result) -> reports.ShowReport:
    """Report on runs without a target."""
    rows = [
        reports.RunRow(sample.seed or 0, sample.primitives, "" if sample.primitives else f"{sample.value!r}")
        for sample in result
    ]
    return reports.ShowReport(rows)


def sheet(reference: shell.references.ModelReference, result: nw.Result, **settings: Any) -> Image:
    """Draw the runs that emitted shapes side by side, each with its number and its seed."""
    if reference.entry is not None and reference.entry.draws is not None:
        settings["style"] = reference.entry.draws
    shown = [(number, sample) for number, sample in enumerate(result, 1) if sample.primitives]
    captions = [f"#{number}   seed {sample.seed}" for number, sample in shown]
    image: Image = draw.sheet.sheet([sample.scene for _, sample in shown], captions, **settings)
    return image


def start(reference: shell.references.ModelReference) -> dict[str, Any]:
    """Return the start of a gallery model that follows a drawing: the start of its own drawing."""
    entry = reference.entry
    return {} if entry is None or entry.drawing_name is None else reference.start(entry.asks)


def prior_runs(model: nw.Model[..., Any], values: dict[str, Any], count: int, seed: int) -> nw.Result:
    """Return the first runs that are possible, of the seed and the seeds after it."""
    first = nw.Search(model, tuple(arguments.bound(model, values)), method=Forward(), seed=seed)
    samples: list[nw.Sample] = []
    causes: Counter[str] = Counter()
    for number in range(TRIES * count):
        sample = replace(first, seed=(seed + number) % 2**64).run().best
        if sample.cause is None:
            samples.append(sample)
        else:
            causes[sample.cause] += 1
        if len(samples) == count:
            break
    if not samples:
        listed = ", ".join(f"{cause} ({times})" for cause, times in causes.most_common())
        raise InputError("every-run-impossible", name=model.name, count=TRIES * count, constraint=listed)
    return nw.Result(first, samples, seed)
