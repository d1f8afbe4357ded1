"""`niwaki replay`: a stored result again, byte for byte."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from niwaki import shell
from niwaki.errors import InputError
from niwaki.result import Result, Sample
from niwaki.shell import folders, formats, pictures, selection, settings
from niwaki.shell.app import app


@app.command()
@settings.with_settings
def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN.JSON", help="A run.json of `niwaki grow` or `sample`.")],
    number: selection.RunNumber = None,
    model: Annotated[
        Path | None,
        typer.Option(
            "--model", metavar="FILE", help="The Python file with the model's host functions. It is run."
        ),
    ] = None,
    trust: Annotated[
        bool,
        typer.Option(
            "--trust",
            help="Run Python files that results name, if they are unchanged. Models with host functions need it.",
        ),
    ] = False,
    anyway: Annotated[
        bool,
        typer.Option(
            "--anyway",
            help="Run the model's file as it is now: keep choices that still fit, list the others, draw new ones.",
        ),
    ] = False,
    *,
    output: folders.Output = None,
    force: folders.Force = False,
    flags: formats.Flags,
    images: pictures.Pictures,
) -> None:
    """Write a stored result again, byte for byte, in any format.

    RUN.JSON contains the model. No Python file is run, unless the model calls host functions: see --trust.
    """
    data = shell.run_files.load(run)
    place, count = selection.place(number, len(data["runs"]), data["best"]), len(data["runs"])
    single_file = folders.one_file(output, formats.SINGLE_FILES, force, **flags.of_folders)

    def files(sample: Sample) -> formats.Files:
        style = shell.run_files.style(data, sample)
        return formats.Files.of_flags(flags, style, single_file)

    if anyway:
        if flags.export is not None:
            reason = "the other results belong to the earlier version of the model"
            raise InputError(
                "flags-exclude",
                flag="--anyway",
                other="--export",
                reason=reason,
                cure="select one result with `--run`",
            )
        changed = shell.replay_changed.replay_changed(data, place, model, run)
        print(changed)
        search = changed.sample.search
        data = shell.run_files.written(Result(search, [changed.sample], search.seed), changed.reference)
        sample, extra = changed.sample, {}
    else:
        allowed = shell.trust.trusted(data, model, trust)
        sample = shell.run_files.replayed(data, place, allowed, run)
        numbers = selection.exported(flags.export, count)
        extra = {n: shell.run_files.replayed(data, n - 1, allowed, run) for n in numbers}
        data["shown"] = place
    if single_file is not None:
        print(shell.results.write_one(single_file, data, sample, files(sample), images))
        return
    with folders.own_folder(output, force, lambda folder: shell.results.is_of(folder, data)) as folder:
        _write(folder, data, sample, extra, files(sample), images)


def _write(
    folder: Path,
    data: dict[str, Any],
    sample: Sample,
    extra: dict[int, Sample],
    files: formats.Files,
    images: pictures.Pictures,
) -> None:
    """Write and print the files of a run, and of the extra runs by their numbers."""
    extra = {number: run for number, run in extra.items() if run.primitives}
    has_picture = images.wanted and sample.primitives > 0
    names = [*files.names(), *(name for number in extra for name in files.names(number))]
    with shell.results.results_folder(folder, data, [*names, *(["best.png"] if has_picture else [])]):
        places = files.write(sample, folder)
        for number, run in extra.items():
            places += files.write(run, folder, number)
        if has_picture:
            places.append(images.best(sample, folder / "best.png", files.style))
        print("\n".join(map(str, places)))
