"""`niwaki color`: a drawing in colours that keep its rules and differ from one another, written to a folder."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer

from niwaki import color as coloring
from niwaki import methods, search
from niwaki.draw.limits import LARGEST
from niwaki.errors.settings import count as whole
from niwaki.shell import folders
from niwaki.shell.app import Folder, app, counted
from niwaki.shell.progress import coloring_line


@app.command()
def color(
    drawing: Annotated[
        str,
        typer.Argument(
            metavar="DRAWING",
            help="An SVG with a class or id for each region, an image whose colours are the regions, "
            "or one of ours: robot, house, bug, rocket.",
        ),
    ],
    rules: Annotated[
        str | None, typer.Option("--rules", metavar="FILE", help="Rules for the regions, a TOML file.")
    ] = None,
    count: Annotated[int, typer.Option("-n", "--count", help="How many colourings.")] = 12,
    output: Folder = None,
    force: folders.Force = False,
    size: Annotated[int, typer.Option("--size", help="Pixels of the longer side of each PNG.")] = 1024,
    measure: Annotated[
        int, typer.Option("--measure", help="Pixels of the longer side at which an SVG is measured.")
    ] = 512,
    weight: Annotated[float, typer.Option("--weight", help="Strictness; larger is stricter.")] = 100.0,
    seed: Annotated[int | None, typer.Option(help="Default: a fresh one, which is printed.")] = None,
    threads: Annotated[
        int | None, typer.Option(help="Default: all cores. Results do not depend on it.")
    ] = None,
) -> None:
    """Color DRAWING in colourings that differ; writes 01.svg, 01.png, ..., sheet.png, colors.json and residuals.csv."""
    methods.at_least_one("--count", count)
    for flag, value in (("--size", size), ("--measure", measure)):
        whole(flag, value, most=LARGEST)
    seed = search.fresh(seed)
    read = coloring.Drawing.load(drawing, measure)
    asked = coloring.Rules.load(rules) if rules is not None else coloring.rules_of(drawing)
    _before(read, asked)
    start = time.perf_counter()
    with folders.own_folder(output, force) as folder:
        with coloring_line(Path(drawing).name) as progress:
            found = coloring.color(
                read, asked, count, weight=weight, seed=seed, threads=threads, progress=progress
            )
        seconds = time.perf_counter() - start
        written = coloring.files.write(found, folder, size)
    _summary(found, seconds, seed)
    print(f"{len(written)} files in {folder}, sheet.png first of all")


def _before(drawing: coloring.Drawing, rules: coloring.Rules) -> None:
    """What is known before the search: regions, and how near the rules can come to holding."""
    rules.check(drawing.names)
    print(f"{len(drawing.names)} regions, {len(drawing.pairs)} pairs of neighbours, {len(list(rules))} rules")
    if drawing.hidden:
        print(f"warning: no pixel shows {', '.join(drawing.hidden)}")
    slack, forced = coloring.agree.least_slack(rules)
    if slack > 0.5:
        print(f"warning: not all rules can hold; some will be {slack:.1f} units off:")
        print("\n".join(f"  {one}" for one in forced))


def _summary(found: list[coloring.Coloring], seconds: float, seed: int) -> None:
    """A line for each colouring: its score and the rule that it keeps worst."""
    print(f"{counted(len(found), 'colouring')} in {seconds:.1f} s, seed {seed}")
    for k, one in enumerate(found):
        line = f"  {k + 1:02}  log score {one.log_score:9.2f}"
        if one.kept:
            worst = max(one.kept, key=lambda kept: abs(kept.residual))
            line += f"  {abs(worst.residual):5.1f} off: {worst.rule}"
        print(line)
