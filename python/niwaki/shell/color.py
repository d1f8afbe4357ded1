"""`niwaki color`: a drawing in colours that keep its rules and differ from one another, written to a folder."""

from __future__ import annotations

import time
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated

import typer

from niwaki import color as coloring
from niwaki import methods, search
from niwaki.draw.limits import LARGEST
from niwaki.errors.files import write_whole
from niwaki.errors.settings import count as whole
from niwaki.shell import folders
from niwaki.shell.app import Runs, Seed, Threads, app, counted
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
    runs: Runs = 12,
    output: folders.Output = None,
    force: folders.Force = False,
    side: Annotated[
        int, typer.Option("--side", metavar="N", help="Pixels of the longer side of each PNG.")
    ] = 1024,
    pixels: Annotated[
        int, typer.Option("--pixels", metavar="N", help="Longer side of a drawing when it is measured.")
    ] = 512,
    strictness: Annotated[
        float, typer.Option("--strictness", metavar="NUMBER", help="Of the rules; larger is stricter.")
    ] = 100.0,
    seed: Seed = None,
    threads: Threads = None,
) -> None:
    """Color DRAWING in colourings that differ; writes 01.svg, 01.png, ..., sheet.png, colors.json and residuals.csv."""
    methods.at_least_one("--runs", runs)
    for flag, value in (("--side", side), ("--pixels", pixels)):
        whole(flag, value, most=LARGEST)
    seed = search.fresh(seed)
    read = coloring.Drawing.load(drawing, pixels)
    asked = coloring.Rules.load(rules) if rules is not None else coloring.rules_of(drawing)
    _before(read, asked)
    kinds = ("png", "json", "csv") if read.artwork is None else ("svg", "png", "json", "csv")
    alone = folders.one_file(output, kinds, force)
    start = time.perf_counter()
    with folders.own_folder(output, force) if alone is None else nullcontext() as folder:
        with coloring_line(Path(drawing).name) as progress:
            found = coloring.color(
                read, asked, runs, strictness=strictness, seed=seed, threads=threads, progress=progress
            )
        seconds = time.perf_counter() - start
        if folder is not None:
            written = coloring.files.write(found, folder, side)
    _summary(found, seconds, seed)
    if alone is None:
        print(f"{len(written)} files in {folder}, sheet.png first of all")
        return
    made = coloring.files.contents(found, side)
    # Of one colouring the sheet is a picture with a number.
    first = next(
        name for name in made if name.endswith(alone.suffix.lower()) and (runs > 1 or name != "sheet.png")
    )
    print(write_whole(alone, made[first]()))


def _before(drawing: coloring.Drawing, rules: coloring.Rules) -> None:
    """What is known before the search: regions, and how near the rules can come to holding."""
    rules.check(drawing.names)
    print(f"{len(drawing.names)} regions, {len(drawing.pairs)} pairs of neighbours, {len(list(rules))} rules")
    if drawing.hidden:
        print(f"warning: no pixel shows {', '.join(drawing.hidden)}")
    slack, forced = coloring.consistency.least_slack(rules)
    if slack > 0.5:
        print(f"warning: not all rules can hold; some will be {slack:.1f} units off:")
        print("\n".join(f"  {one}" for one in forced))


def _summary(found: list[coloring.Coloring], seconds: float, seed: int) -> None:
    """A line for each colouring: its score and the rule that it keeps worst."""
    print(f"{counted(len(found), 'colouring')} in {seconds:.1f} s, seed {seed}")
    for k, one in enumerate(found):
        line = f"  {k + 1:02}  log score {one.log_score:9.2f}"
        if one.report:
            worst = max(one.report, key=lambda row: abs(row.residual))
            line += f"  {abs(worst.residual):5.1f} off: {worst.rule}"
        print(line)
