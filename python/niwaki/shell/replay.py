"""`niwaki replay`: the best of a search once more, byte for byte."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from niwaki.shell.app import Folder, app, made_folder

if TYPE_CHECKING:
    from niwaki.target import Target


@app.command()
def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN.JSON", help="What `niwaki grow` wrote.")],
    output: Folder = None,
    picture: Annotated[bool, typer.Option("--picture/--no-picture", help="Draw best.png.")] = True,
) -> None:
    """Make the best mesh of a search again, byte for byte."""
    from niwaki.run_files import load, replayed, target_hash

    data = load(run)
    sample = replayed(data)
    folder = made_folder(output or Path("out"))
    print(sample.export(folder / "best.glb"))
    if picture and sample.primitives:
        aim = _same_target(data)
        if aim is not None and target_hash(aim) != data["target"]["hash"]:
            print("warning: the target has changed since this run; its ghost is today's", file=sys.stderr)
        print(sample.save(folder / "best.png", aim))


def _same_target(data: dict[str, Any]) -> Target | None:
    """The target of a search that was written down, where it is still there."""
    from niwaki.gallery import named_target
    from niwaki.target import Target

    reference = str(data["target"]["reference"])
    if reference.startswith("gallery:"):
        return named_target(reference.removeprefix("gallery:"))
    if Path(reference).is_file():
        return Target.load(reference)
    print(f"warning: the target {reference} is not there; the picture is without its ghost", file=sys.stderr)
    return None
