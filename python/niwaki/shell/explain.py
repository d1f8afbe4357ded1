"""`niwaki explain`: the work of each strategy for one proposal, as a picture."""

from __future__ import annotations

from typing import Annotated

import typer

from niwaki import draw, search, shell
from niwaki.shell import folders
from niwaki.shell.app import ModelName, Seed, app


@app.command()
def explain(
    model: ModelName,
    choice: Annotated[
        str,
        typer.Option(
            "--choice", metavar="ADDRESS", help="The choice to change, by its address or a pattern."
        ),
    ],
    seed: Seed = None,
    output: Annotated[str | None, folders.output("explain.svg")] = None,
    force: folders.Force = False,
) -> None:
    """Draw which calls of MODEL each strategy runs, resumes, skips, creates and removes for one proposal."""
    reference = shell.references.find(model)
    place = folders.own_file(output, "explain.svg", ("svg", "png"), force)
    seed = search.fresh(seed)
    report = search.explain(reference.model, choice, seed=seed)
    draw.reuse.draw(report, place)
    total = len(report["activations"])
    old, new = (draw.reuse.value_text(report[key]) for key in ("old", "new"))
    print(f"{report['label']} ({report['path']}): {old} becomes {new}; {total} calls, seed {seed}")
    print(f"{'':<8}" + "".join(f"{word:>20}" for word in draw.reuse.WORDS.values()))
    for name, (steps, _) in report["runs"].items():
        print(f"{name:<8}" + "".join(f"{n:>20}" for n in draw.reuse.counts(steps, total).values()))
    print(place)
