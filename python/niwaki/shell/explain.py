"""`niwaki explain`: what each strategy does for one proposal, as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from niwaki.draw.reuse import WORDS, counts, draw, said
from niwaki.search import explain as explained
from niwaki.shell.app import ModelName, app, made_folder
from niwaki.shell.finding import find


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
    found = find(model)
    told = explained(found.model, choice, seed=seed)
    made_folder(output.parent)
    draw(told, output)
    total = len(told["activations"])
    print(f"{told['path']}: {said(told['old'])} becomes {said(told['new'])}; {total} calls")
    print(f"{'':<8}" + "".join(f"{word:>20}" for word in WORDS.values()))
    for name, (steps, _) in told["runs"].items():
        print(f"{name:<8}" + "".join(f"{n:>20}" for n in counts(steps, total).values()))
    print(output)
