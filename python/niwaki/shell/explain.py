"""`niwaki explain`: what each strategy does for one proposal, as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from niwaki import draw, search, shell
from niwaki.errors.files import check_place, ensure_folder
from niwaki.shell.app import ModelName, app


@app.command()
def explain(
    model: ModelName,
    choice: Annotated[
        str,
        typer.Option("--choice", metavar="ADDRESS", help="The choice to change; a pattern is possible."),
    ],
    seed: Annotated[int, typer.Option(help="The seed of the first state and the proposal.")] = 0,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="A .svg or .png file.")
    ] = Path("explain.svg"),
) -> None:
    """Draw which calls of MODEL each strategy runs, resumes, skips, creates and removes for a proposal."""
    found = shell.references.find(model)
    check_place(ensure_folder(output.parent) / output.name)
    explained = search.explain(found.model, choice, seed=seed)
    draw.reuse.draw(explained, output)
    total = len(explained["activations"])
    old, new = (draw.reuse.value_text(explained[key]) for key in ("old", "new"))
    print(f"{explained['path']}: {old} becomes {new}; {total} calls")
    print(f"{'':<8}" + "".join(f"{word:>20}" for word in draw.reuse.WORDS.values()))
    for name, (steps, _) in explained["runs"].items():
        print(f"{name:<8}" + "".join(f"{n:>20}" for n in draw.reuse.counts(steps, total).values()))
    print(output)
