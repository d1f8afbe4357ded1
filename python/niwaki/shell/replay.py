"""`niwaki replay`: the best of a search once more, byte for byte."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from niwaki import shell
from niwaki.errors import InputError
from niwaki.result import Result, Sample
from niwaki.shell import folders, picking, pictures, settings, writing
from niwaki.shell.app import app


@app.command()
@settings.with_settings
def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN.JSON", help="The file that `niwaki grow` wrote.")],
    number: picking.RunNumber = None,
    model: Annotated[
        Path | None,
        typer.Option(
            "--model", metavar="FILE", help="The Python file with the model's host functions; it is run."
        ),
    ] = None,
    trust: Annotated[
        bool,
        typer.Option(
            "--trust",
            help="Run the Python files that results name, where unchanged: for models with host functions.",
        ),
    ] = False,
    anyway: Annotated[
        bool,
        typer.Option(
            "--anyway",
            help="Run the model's file as it is now: keep the choices that still fit, say which do not, draw new ones.",
        ),
    ] = False,
    *,
    output: folders.Output = None,
    force: folders.Force = False,
    flags: writing.Flags,
    drawn: pictures.Pictures,
) -> None:
    """Write the best result of a search again, byte for byte, in any format.

    The model is in RUN.JSON, and no Python file is run, unless the model calls host functions: see --trust.
    """
    data = shell.run_files.load(run)
    place, count = picking.place(number, len(data["runs"]), data["best"]), len(data["runs"])
    alone = folders.one_file(output, writing.ALONE, force, **flags.of_folders)

    def files(sample: Sample) -> writing.Files:
        style = shell.run_files.style(data, sample)
        return writing.Files.of_flags(flags, style, alone)

    if anyway:
        if flags.export is not None:
            reason = "the other results are of the model as it was"
            raise InputError(
                "flags-exclude",
                flag="--anyway",
                other="--export",
                reason=reason,
                cure="take one result, with `--run`",
            )
        changed = shell.anyway.replayed(data, place, model, run)
        print(changed)
        search = changed.sample.search
        data = shell.run_files.written(Result(search, [changed.sample], search.seed), changed.found)
        sample, others = changed.sample, {}
    else:
        allowed = shell.trust.trusted(data, model, trust)
        sample = shell.run_files.replayed(data, place, allowed, run)
        numbers = picking.exported(flags.export, count)
        others = {one: shell.run_files.replayed(data, one - 1, allowed, run) for one in numbers}
        data["shown"] = place
    if alone is not None:
        print(shell.results.write_one(alone, data, sample, files(sample), drawn))
        return
    with folders.own_folder(output, force, lambda folder: shell.results.is_of(folder, data)) as folder:
        _write(folder, data, sample, others, files(sample), drawn)


def _write(
    folder: Path,
    data: dict[str, Any],
    sample: Sample,
    others: dict[int, Sample],
    files: writing.Files,
    drawn: pictures.Pictures,
) -> None:
    """Write the files of a run and those of others by their numbers, and say which."""
    others = {number: one for number, one in others.items() if one.primitives}
    pictured = drawn.wanted and sample.primitives > 0
    names = [*files.names(), *(name for number in others for name in files.names(number))]
    with shell.results.written(folder, data, [*names, *(["best.png"] if pictured else [])]):
        found = files.write(sample, folder)
        for number, one in others.items():
            found += files.write(one, folder, number)
        if pictured:
            found.append(drawn.best(sample, folder / "best.png", files.style))
        print("\n".join(map(str, found)))
