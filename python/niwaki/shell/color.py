"""`niwaki color`: colourings of a drawing that obey its rules and differ from each other, written to a folder."""

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
            help="An SVG with a class or id for each region, an image with a colour for each region, "
            "or a drawing of the package: robot, house, bug, rocket.",
        ),
    ],
    rules: Annotated[
        str | None, typer.Option("--rules", metavar="FILE", help="A TOML file with rules for the regions.")
    ] = None,
    runs: Runs = 12,
    output: folders.Output = None,
    force: folders.Force = False,
    side: Annotated[
        int, typer.Option("--side", metavar="N", help="Longer side of each PNG, in pixels.")
    ] = 1024,
    pixels: Annotated[
        int,
        typer.Option(
            "--pixels", metavar="N", help="Longer side of the drawing when it is measured, in pixels."
        ),
    ] = 512,
    strictness: Annotated[
        float,
        typer.Option("--strictness", metavar="NUMBER", help="Strictness of the rules; larger is stricter."),
    ] = 100.0,
    seed: Seed = None,
    threads: Threads = None,
) -> None:
    """Colour DRAWING in several ways. Writes 01.svg, 01.png, ..., sheet.png, colors.json and residuals.csv."""
    methods.at_least_one("--runs", runs)
    for flag, value in (("--side", side), ("--pixels", pixels)):
        whole(flag, value, most=LARGEST)
    seed = search.fresh(seed)
    picture = coloring.Drawing.load(drawing, pixels)
    rule_set = coloring.Rules.load(rules) if rules is not None else coloring.rules_of(drawing)
    _preview(picture, rule_set)
    kinds = ("png", "json", "csv") if picture.artwork is None else ("svg", "png", "json", "csv")
    single_file = folders.one_file(output, kinds, force)
    start = time.perf_counter()
    with folders.own_folder(output, force) if single_file is None else nullcontext() as folder:
        with coloring_line(Path(drawing).name) as progress:
            colorings = coloring.color(
                picture, rule_set, runs, strictness=strictness, seed=seed, threads=threads, progress=progress
            )
        seconds = time.perf_counter() - start
        if folder is not None:
            written = coloring.files.write(colorings, folder, side)
    _summary(colorings, seconds, seed)
    if single_file is None:
        print(f"{len(written)} files in {folder}; see sheet.png first")
        return
    contents = coloring.files.contents(colorings, side)
    # The picture of a single colouring is 01.png, not sheet.png.
    first = next(
        name
        for name in contents
        if name.endswith(single_file.suffix.lower()) and (runs > 1 or name != "sheet.png")
    )
    print(write_whole(single_file, contents[first]()))


def _preview(drawing: coloring.Drawing, rules: coloring.Rules) -> None:
    """Print the regions and rules, and a warning about rules that cannot all hold."""
    rules.check(drawing.names)
    print(f"{len(drawing.names)} regions, {len(drawing.pairs)} pairs of neighbours, {len(list(rules))} rules")
    if drawing.hidden:
        print(f"warning: no pixel shows {', '.join(drawing.hidden)}")
    slack, forced = coloring.consistency.least_slack(rules)
    if slack > 0.5:
        print(f"warning: the rules contradict each other; some will be {slack:.1f} units off:")
        print("\n".join(f"  {rule}" for rule in forced))


def _summary(colorings: list[coloring.Coloring], seconds: float, seed: int) -> None:
    """Print a line for each colouring, with its score and the rule that it breaks most."""
    print(f"{counted(len(colorings), 'colouring')} in {seconds:.1f} s, seed {seed}")
    for k, result in enumerate(colorings):
        line = f"  {k + 1:02}  log score {result.log_score:9.2f}"
        if result.report:
            worst = max(result.report, key=lambda rule: abs(rule.residual))
            line += f"  {abs(worst.residual):5.1f} off: {worst.rule}"
        print(line)
