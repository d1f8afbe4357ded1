"""`niwaki replay`: the best of a search once more, byte for byte."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from niwaki.shell import writing
from niwaki.shell.app import Folder, app, made_folder
from niwaki.shell.writing import ANIMATIONS

if TYPE_CHECKING:
    from niwaki.target import Target


@app.command()
def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN.JSON", help="What `niwaki grow` wrote.")],
    number: Annotated[
        int | None, typer.Option("--run", help="Which of its results, from 0; default: the best.")
    ] = None,
    output: Folder = None,
    formats: writing.Formats = "glb",
    scale: writing.Scale = None,
    fuse: writing.Fuse = None,
    frames: writing.Frames = None,
    size: writing.Size = None,
    picture: Annotated[bool, typer.Option("--picture/--no-picture", help="Draw best.png.")] = True,
) -> None:
    """Make the best result of a search again, byte for byte, in any format."""
    from niwaki.run_files import load, replayed, target_hash

    files = writing.Files.asked(formats, scale, fuse, frames, size)
    data = load(run)
    sample = replayed(data, number)
    folder = made_folder(output or Path("out"))
    aim = (
        _same_target(data)
        if (picture and sample.primitives) or set(files.formats) & set(ANIMATIONS)
        else None
    )
    if aim is not None and target_hash(aim) != data["target"]["hash"]:
        print("warning: the target has changed since this run; its ghost is today's", file=sys.stderr)
    for place in files.write(sample, folder, aim):
        print(place)
    if picture and sample.primitives:
        print(sample.save(folder / "best.png", aim))


def _same_target(data: dict[str, Any]) -> Target | None:
    """The target of a search that was written down, where it is still there."""
    from niwaki.gallery import named_target
    from niwaki.target import Target

    if data["target"]["reference"] is None:
        return None
    reference = str(data["target"]["reference"])
    if reference.startswith("gallery:"):
        return named_target(reference.removeprefix("gallery:"))
    if Path(reference).is_file():
        return Target.load(reference)
    print(f"warning: the target {reference} is not there; the picture is without its ghost", file=sys.stderr)
    return None
