"""`niwaki show`: runs of a model as they come, with no target, as a sheet."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from typing import Annotated, Any

import niwaki as nw
from niwaki import draw, methods, search, shell
from niwaki.draw.limits import PIXEL
from niwaki.draw.picture import IMAGE_FORMATS
from niwaki.errors import InputError
from niwaki.errors.memory import check_room
from niwaki.methods import Forward
from niwaki.shell import arguments, folders, pictures
from niwaki.shell.app import ModelName, Runs, Seed, app, counted
from niwaki.shell.clock import Clock

#: So many runs are tried for each that is shown: the others break a constraint of the model.
TRIES = 50
#: Pixels of a cell of the sheet, and rays for each where it changes.
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
) -> None:
    """Draw runs of MODEL side by side, as they come, with no target: what the model makes."""
    clock = Clock()
    cell = (CELL[0] // 2, CELL[1] // 2) if quick else CELL
    check_room("--runs", methods.at_least_one("--runs", runs), cell[0] * cell[1] * PIXEL, "picture")
    place = folders.own_file(output, "show.png", [one[1:] for one in IMAGE_FORMATS], force)
    with clock.part("compile"):
        found = shell.references.find(model)
        given = {**_begin(found), **arguments.read(found.model, values, preset)}
        found.model.program()
    with clock.part("runs"):
        result = _runs(found.model, given, runs, search.fresh(seed))
    for number, one in enumerate(result, 1):
        made = counted(one.primitives, "primitive") if one.primitives else f"{one.value!r}"
        print(f"#{number}   seed {one.seed}   {made}")
    if not any(one.primitives for one in result):
        print("no run emitted a shape, so there is no picture")
        return
    with clock.part("picture"):
        style = {} if found.entry is None or found.entry.draws is None else {"style": found.entry.draws}
        sheet: dict[str, Any] = {"size": cell, "samples": 1 if quick else SAMPLES, **style}
        shown = [(number, one) for number, one in enumerate(result, 1) if one.primitives]
        captions = [f"#{number}   seed {one.seed}" for number, one in shown]
        scenes = [one.scene for _, one in shown]
        draw.picture.save_image(lambda: draw.sheet.sheet(scenes, captions, **sheet), place)
    print(f"{place}   {clock}")


def _begin(found: shell.references.ModelReference) -> dict[str, Any]:
    """Where a model of the gallery begins that follows a drawing: where its own drawing does."""
    return {} if found.entry is None or found.entry.drawing_name is None else found.start(found.entry.asks)


def _runs(model: nw.Model[..., Any], given: dict[str, Any], count: int, seed: int) -> nw.Result:
    """The first possible runs of a seed and those that follow it."""
    first = nw.Search(model, tuple(arguments.bound(model, given)), method=Forward(), seed=seed)
    kept: list[nw.Sample] = []
    causes: Counter[str] = Counter()
    for number in range(TRIES * count):
        one = replace(first, seed=(seed + number) % 2**64).run().best
        if one.cause is None:
            kept.append(one)
        else:
            causes[one.cause] += 1
        if len(kept) == count:
            break
    if not kept:
        listed = ", ".join(f"{cause} ({times})" for cause, times in causes.most_common())
        raise InputError("every-run-impossible", name=model.name, count=TRIES * count, constraint=listed)
    return nw.Result(first, kept, seed)
