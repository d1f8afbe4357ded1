"""`niwaki grow`: a search, written to a folder."""

from __future__ import annotations

import json
import sys
from contextlib import nullcontext
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import result as results
from niwaki import shell
from niwaki.errors import InputError
from niwaki.errors.folders import held_folder
from niwaki.errors.schema import fitted
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS
from niwaki.shell import (
    arguments,
    asking,
    controls,
    folders,
    held,
    picking,
    pictures,
    resuming,
    settings,
    writing,
)
from niwaki.shell.app import Folder, Megabytes, app, counted
from niwaki.shell.clock import Clock
from niwaki.shell.progress import progress_line


@app.command()
@settings.with_settings(
    *settings.METHODS.values(),
    power="16, with absolute weights 1",
    particles="the model's own, or 300; of improve a third",
)
def grow(
    context: typer.Context,
    model: resuming.Model = None,
    values: arguments.Arguments = None,
    preset: arguments.Preset = None,
    target: controls.TargetFile = None,
    avoid: controls.AvoidFiles = None,
    floor: controls.Floor = None,
    within: controls.Within = None,
    match_image: controls.ImageFile = None,
    match_shadow: controls.ShadowFile = None,
    camera: controls.CameraFile = None,
    weight_image: controls.WeightFile = None,
    weight: controls.Weight = None,
    light: controls.Light = None,
    receiver: controls.ReceiverFile = None,
    window: controls.Window = None,
    pixels: controls.Pixels = None,
    voxel: controls.Voxel = None,
    sigma: controls.Sigma = None,
    rule: Annotated[str, typer.Option(help="Which parts count as intersecting: solid or surface.")] = "solid",
    method: settings.MethodName = None,
    guide: settings.GuideFile = None,
    polish: settings.Polish = None,
    polish_kernel: settings.PolishKernel = None,
    origin: held.From = None,
    number: held.OfRun = None,
    lock: held.Lock = None,
    reroll: held.Reroll = None,
    runs: Annotated[int, typer.Option(help="How many results, with seeds SEED, SEED + 1, ...")] = 1,
    seed: Annotated[int | None, typer.Option(help="Default: a new one, which run.json keeps.")] = None,
    threads: Annotated[
        int | None, typer.Option(help="Default: all cores. Results do not depend on it.")
    ] = None,
    max_steps: Annotated[int, typer.Option(help="Most calls and loop steps of one run.")] = MAX_STEPS,
    max_memory: Megabytes = MAX_MEMORY >> 20,
    resume: resuming.Resume = None,
    output: Folder = None,
    force: folders.Force = False,
    formats: writing.Formats = None,
    scale: writing.Scale = None,
    fuse: writing.Fuse = None,
    frames: writing.Frames = None,
    size: writing.Size = None,
    export: picking.Export = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as JSON; files are written only with -o.")
    ] = False,
    picture: Annotated[
        bool,
        typer.Option(
            "--picture/--no-picture", help="Draw best.png, sheet.png and the pictures that were matched."
        ),
    ] = True,
    quick: pictures.Quick = False,
    **given: Any,
) -> None:
    """Grow MODEL into its target; writes best.glb (best.svg of a drawing), best.png, sheet.png and run.json."""
    clock = Clock()
    if resume is not None:
        search_left, found, wanted, checkpoint = resuming.left(context, resume, "grow", Wanted.of_data)
        with held_folder(resume) as folder:
            with clock.part("search"):
                with progress_line(found.reference) as progress, resuming.told(checkpoint, "grow"):
                    result = search_left.run(threads=threads, progress=progress, checkpoint=checkpoint)
            _end(result, found, folder, wanted, as_json, checkpoint, clock)
        return
    with clock.part("compile"):
        found = shell.references.find(resuming.required(context, model))
        own_values = arguments.read(found.model, values, preset)
        found.model.program()
    onto = held.Origin.of_flags(origin, number, lock, reroll)
    style = None if found.entry is None else found.entry.draws
    chosen = controls.Controls(
        target,
        tuple(avoid or ()),
        floor,
        within,
        match_image,
        camera,
        match_shadow,
        weight_image,
        weight,
        light,
        receiver,
        window,
        pixels,
        style is not None,
    )
    wish = asking.Asked(
        chosen,
        voxel,
        sigma,
        rule,
        method,
        guide,
        polish,
        polish_kernel,
        runs,
        seed,
        max_steps,
        max_memory,
        given,
    )
    style = style or ("ink" if chosen.is_drawing else None)
    files = writing.Files.of_flags(formats, scale, fuse, frames, size, style)
    with clock.part("target"):
        asked = wish.search(found, own_values, None if onto is None else onto.held)
    most = runs if given.get("diverse") is None else given["diverse"]
    picking.exported(export, most)
    writes = output is not None or not as_json
    # Before the search: that a folder cannot be written to must not be the news at its end.
    wanted = Wanted(files, picture, quick, export, None if onto is None else onto.data())
    with folders.own_folder(output, force) if writes else nullcontext() as folder:
        if folder is not None:
            # Of a search that failed here.
            (folder / pictures.IMPOSSIBLE).unlink(missing_ok=True)
        kept = None
        rerolls = onto is not None and bool(onto.reroll)
        if folder is not None and not rerolls:
            kept = resuming.begun(folder, "grow", found, **asdict(wanted))
        try:
            with clock.part("search"):
                if onto is not None and rerolls:
                    result = onto.rerolled(asked, given.get("particles"), threads)
                else:
                    with progress_line(found.reference) as progress, resuming.told(kept, "grow"):
                        result = asked.run(threads=threads, progress=progress, checkpoint=kept)
        except InputError as error:
            if error.code == "everything-impossible" and folder is not None and picture and style is None:
                if said := pictures.impossible(asked, folder, quick):
                    print(said, file=sys.stderr)
            raise
        _end(result, found, folder, wanted, as_json, kept, clock)


@dataclass(frozen=True)
class Wanted:
    """What to write of a result, kept in a checkpoint.

    Attributes
    ----------
    files
        The files of the best, and of those that are exported.
    picture, quick
        Whether pictures are drawn, and as drafts.
    export
        Numbers of results, as typed.
    origin
        What the search goes on from.
    """

    files: writing.Files
    picture: bool
    quick: bool
    export: str | None
    origin: dict[str, Any] | None

    @classmethod
    def of_data(cls, data: dict[str, Any]) -> Wanted:
        """Read from JSON what `dataclasses.asdict` gave."""
        writing.Files.of_data(data["files"])
        wanted: Wanted = fitted(data, cls)
        return wanted


def _end(
    result: nw.Result,
    found: shell.references.ModelReference,
    folder: Path | None,
    wanted: Wanted,
    as_json: bool,
    checkpoint: nw.Checkpoint | None,
    clock: Clock,
) -> None:
    """Write the files, where there is a folder for them, and say what was found."""
    if folder is not None:
        data = shell.run_files.written(result, found)
        if wanted.origin is not None:
            data["origin"] = wanted.origin
        with resuming.ended(result, checkpoint):
            _write(folder, result, data, wanted, clock)
    if as_json:
        print(json.dumps({"runs": [shell.run_files.numbers(sample) for sample in result]}))
    elif folder is not None:
        _summary(result, folder, clock)
    if result.interrupted:
        if folder is not None:
            print(resuming.interrupted(folder, "grow"), file=sys.stderr if as_json else sys.stdout)
        raise typer.Exit(130)


def _write(
    folder: Path,
    result: nw.Result,
    data: dict[str, Any],
    wanted: Wanted,
    clock: Clock,
) -> None:
    """Write run.json first: the other files can be created again from it."""
    best: nw.Sample = result.best
    if best.primitives == 0:
        with shell.results.written(folder, data, ()):
            print(
                "warning: the best run emitted nothing, so there is no mesh and no picture", file=sys.stderr
            )
        return
    files, drawn = wanted.files, pictures.Pictures(wanted.picture, wanted.quick)
    numbers = picking.exported(wanted.export, len(result))
    picked = [(number, result[number - 1]) for number in numbers if result[number - 1].primitives]
    names = [*files.names(), *(name for number, _ in picked for name in files.names(number))]
    with shell.results.written(folder, data, [*names, *drawn.names(result, files.style)]):
        with clock.part("pictures"):
            drawn.write(result, folder, files.style)
        with clock.part("files"):
            files.write(best, folder)
            for number, sample in picked:
                files.write(sample, folder, number)


def _summary(result: nw.Result, folder: Path, clock: Clock) -> None:
    if isinstance(result.info, results.info.ImproveInfo) and len({sample.seed for sample in result}) == 1:
        print(result.info)
    if losses := str(getattr(result.info, "losses", "")):
        print(losses)
    for number, sample in enumerate(result, 1):
        print(f"{results.caption(sample, number)}   {counted(sample.primitives, 'primitive')}")
    print(f"best: #{result.samples.index(result.best) + 1}; files in {folder}")
    print(clock)
