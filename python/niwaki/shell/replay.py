"""`niwaki replay`: the best of a search once more, byte for byte."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from niwaki import shell
from niwaki.errors.folders import held_folder
from niwaki.shell import writing
from niwaki.shell.app import Folder, app


@app.command()
def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN.JSON", help="The file that `niwaki grow` wrote.")],
    number: Annotated[
        int | None, typer.Option("--run", help="Which of its results, from 0; default: the best.")
    ] = None,
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
            help="Run the Python file that RUN.JSON names, where it is unchanged: for models with host functions.",
        ),
    ] = False,
    output: Folder = None,
    formats: writing.Formats = None,
    scale: writing.Scale = None,
    fuse: writing.Fuse = None,
    frames: writing.Frames = None,
    size: writing.Size = None,
    picture: Annotated[bool, typer.Option("--picture/--no-picture", help="Draw best.png.")] = True,
) -> None:
    """Write the best result of a search again, byte for byte, in any format.

    The model is in RUN.JSON, and no Python file is run, unless the model calls host functions: see --trust.
    """
    data = shell.run_files.load(run)
    with held_folder(output or Path("out")) as folder:
        shell.results.refuse_another(folder, data)
        allowed = shell.trust.trusted(data, model, trust)
        sample = shell.run_files.replayed(data, number, allowed, run)
        files = writing.Files.of_flags(
            formats, scale, fuse, frames, size, shell.run_files.style(data, sample)
        )
        data["shown"] = data["best"] if number is None else number
        pictured = picture and sample.primitives
        with shell.results.written(folder, data, [*files.names, *(["best.png"] if pictured else [])]):
            for place in files.write(sample, folder):
                print(place)
            if pictured:
                styled: dict[str, Any] = (
                    {} if files.style is None else {"style": files.style, "size": (800, 800)}
                )
                print(sample.save(folder / "best.png", **styled))
