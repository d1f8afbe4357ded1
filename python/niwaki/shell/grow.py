"""`niwaki grow`: a search, written to a folder."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
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
from niwaki.shell import (
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
from niwaki.shell.app import Threads, app, counted
from niwaki.shell.clock import Clock
from niwaki.shell.progress import progress_line
from niwaki.targets.asks import DRAWN


@app.command()
@settings.with_settings
def grow(
    context: typer.Context,
    what: resuming.What,
    wish: controls.Wish,
    how: asking.How,
    origin: held.Flags,
    out: folders.Out,
    flags: writing.Flags,
    drawn: pictures.Pictures,
    threads: Threads = None,
    *,
    given: Annotated[
        dict[str, Any],
        settings.of_methods(
            *settings.METHODS.values(),
            power="16, with absolute weights 1",
            particles="the model's own, or 300; of improve a third",
        ),
    ],
) -> None:
    """Grow MODEL into its target; writes best.glb (best.svg of a drawing), best.png, sheet.png and run.json."""
    clock = Clock()
    if what.resume is not None:
        search, found, wanted, checkpoint = resuming.left(context, what.resume, "grow", Wanted.of_data)
        with held_folder(what.resume) as folder:
            result = _searched(search, found, threads, checkpoint, clock)
            _end(result, found, folder, wanted, out, checkpoint, clock)
        return
    with clock.part("compile"):
        found, arguments = resuming.model_of(context, what)
        found.model.program()
    alone = out.alone(writing.ALONE, **flags.of_folders)
    patterns, values = held.read(origin)
    onto = held.Origin.of_flags(origin, patterns)
    asks = controls.asked(wish, found)
    style = found.style or ("ink" if any(sketch in DRAWN for sketch, _ in asks) else None)
    files = writing.Files.of_flags(flags, style, alone)
    with clock.part("target"):
        search = asking.searched(
            found, asks, how, given, arguments, {**values, **(onto.held if onto else {})} or None
        )
    picking.exported(flags.export, how.runs if given["diverse"] is None else given["diverse"])
    wanted = Wanted(files, drawn, flags.export, None if onto is None else onto.data())
    # Before the search: that a folder cannot be written to must not be the news at its end.
    with out.folder(alone) as folder:
        if folder is not None:
            # Of a search that failed here.
            (folder / pictures.IMPOSSIBLE).unlink(missing_ok=True)
        with _shown(search, folder if drawn.wanted and style is None else None, drawn.quick):
            kept: nw.Checkpoint | None = None
            if onto is not None and onto.reroll:
                with clock.part("search"):
                    result = onto.rerolled(search, given["particles"], threads)
            else:
                if folder is not None:
                    kept = resuming.begun(folder, "grow", found, **asdict(wanted))
                result = _searched(search, found, threads, kept, clock)
        _end(result, found, folder, wanted, out, kept, clock, alone)


def _searched(
    search: nw.Search,
    found: shell.references.ModelReference,
    threads: int | None,
    checkpoint: nw.Checkpoint | None,
    clock: Clock,
) -> nw.Result:
    """Carry it out, with a line about its progress."""
    with clock.part("search"):
        with progress_line(found.reference) as progress, resuming.told(checkpoint, "grow"):
            return search.run(threads=threads, progress=progress, checkpoint=checkpoint)


@contextmanager
def _shown(search: nw.Search, folder: Path | None, quick: bool) -> Iterator[None]:
    """Where every run is impossible, a picture in the folder shows why."""
    try:
        yield
    except InputError as error:
        if error.code == "everything-impossible" and folder is not None:
            if said := pictures.impossible(search, folder, quick):
                print(said, file=sys.stderr)
        raise


@dataclass(frozen=True)
class Wanted:
    """What to write of a result, kept in a checkpoint.

    Attributes
    ----------
    files
        The files of the best, and of those that are exported.
    drawn
        Which pictures are drawn.
    export
        Numbers of results, as typed.
    origin
        What the search goes on from.
    """

    files: writing.Files
    drawn: pictures.Pictures
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
    out: folders.Out,
    checkpoint: nw.Checkpoint | None,
    clock: Clock,
    alone: Path | None = None,
) -> None:
    """Write the files, where there is a folder for them, or the one `alone`, and say what was found."""
    place = alone or folder
    if place is not None:
        data = shell.run_files.written(result, found)
        if wanted.origin is not None:
            data["origin"] = wanted.origin
        if alone is not None:
            with clock.part("files"):
                drawn = pictures.Pictures(quick=wanted.drawn.quick)
                shell.results.write_one(alone, data, result.best, wanted.files, drawn)
        else:
            with resuming.ended(result, checkpoint):
                _write(place, result, data, wanted, clock)
    if out.as_json:
        print(json.dumps({"runs": [shell.run_files.numbers(sample) for sample in result]}))
    elif place is not None:
        _summary(result, place, clock)
    if result.interrupted:
        if folder is not None:
            print(resuming.interrupted(folder, "grow"), file=out.stream)
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
    files, drawn = wanted.files, wanted.drawn
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


def _summary(result: nw.Result, place: Path, clock: Clock) -> None:
    if isinstance(result.info, results.info.ImproveInfo) and len({sample.seed for sample in result}) == 1:
        print(result.info)
    if losses := str(getattr(result.info, "losses", "")):
        print(losses)
    for number, sample in enumerate(result, 1):
        print(f"{results.caption(sample, number)}   {counted(sample.primitives, 'primitive')}")
    print(f"best: #{result.samples.index(result.best) + 1}; {folders.said(place)}")
    print(clock)
