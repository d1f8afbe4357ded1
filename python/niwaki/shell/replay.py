"""`niwaki replay`: the best of a search once more, byte for byte."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from niwaki import shell
from niwaki.shell import writing
from niwaki.shell.app import Folder, app, ensure_folder


@app.command()
def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN.JSON", help="The file that `niwaki grow` wrote.")],
    number: Annotated[
        int | None, typer.Option("--run", help="Which of its results, from 0; default: the best.")
    ] = None,
    output: Folder = None,
    formats: writing.Formats = None,
    scale: writing.Scale = None,
    fuse: writing.Fuse = None,
    frames: writing.Frames = None,
    size: writing.Size = None,
    picture: Annotated[bool, typer.Option("--picture/--no-picture", help="Draw best.png.")] = True,
) -> None:
    """Write the best result of a search again, byte for byte, in any format."""
    data = shell.run_files.load(run)
    sample = shell.run_files.replayed(data, number)
    files = writing.Files.of_flags(formats, scale, fuse, frames, size, shell.run_files.style(data, sample))
    folder = ensure_folder(output or Path("out"))
    for place in files.write(sample, folder):
        print(place)
    if picture and sample.primitives:
        styled: dict[str, Any] = {} if files.style is None else {"style": files.style, "size": (800, 800)}
        print(sample.save(folder / "best.png", **styled))
