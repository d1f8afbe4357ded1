"""`niwaki sample`: Markov chains, written to a folder."""

from __future__ import annotations

import csv
import io
import json
import sys
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import kernels, shell
from niwaki.draw import finite
from niwaki.errors.files import write_whole
from niwaki.errors.folders import held_folder
from niwaki.errors.schema import fitted
from niwaki.errors.settings import MAX_MEMORY
from niwaki.methods import Mh
from niwaki.shell import arguments, folders, pictures, resuming, settings
from niwaki.shell.app import Folder, Megabytes, app
from niwaki.shell.progress import sampling_line


@app.command()
@settings.with_settings(Mh, chains="4", warmup="a fifth of all", keep="100", kernel="prior()")
def sample(
    context: typer.Context,
    model: resuming.Model = None,
    values: arguments.Arguments = None,
    preset: arguments.Preset = None,
    target: Annotated[
        str | None,
        typer.Option(
            "--target",
            metavar="FILE",
            help="A mesh to fill, or `gallery:` and a target's name; without self-intersection.",
        ),
    ] = None,
    voxel: Annotated[float | None, typer.Option(metavar="SIZE", help="Cell size for the target.")] = None,
    sigma: Annotated[float, typer.Option(help="Strictness of the match.")] = 0.02,
    seed: Annotated[int | None, typer.Option(help="Default: a new one, which run.json keeps.")] = None,
    threads: Annotated[int | None, typer.Option(help="Default: all cores.")] = None,
    max_memory: Megabytes = MAX_MEMORY >> 20,
    resume: resuming.Resume = None,
    output: Folder = None,
    force: folders.Force = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as JSON; files are written only with -o.")
    ] = False,
    picture: Annotated[
        bool, typer.Option("--picture/--no-picture", help="Draw best.png and sheet.png.")
    ] = True,
    quick: pictures.Quick = False,
    **given: Any,
) -> None:
    """Sample MODEL by Markov chains; writes samples.csv and run.json, and best.glb, best.png, sheet.png for scenes."""
    if resume is not None:
        search_left, found, drawn, checkpoint = resuming.left(
            context,
            resume,
            "sample",
            lambda flags: pictures.Pictures(fitted(flags["picture"], bool), fitted(flags["quick"], bool)),
        )
        left = search_left.method
        proposals = left.steps * left.chains if isinstance(left, Mh) else 0
        with held_folder(resume) as folder:
            with sampling_line(found.reference, proposals) as progress, resuming.told(checkpoint, "sample"):
                result = search_left.run(threads=threads, progress=progress, checkpoint=checkpoint)
            _end(result, found, folder, drawn, as_json, checkpoint)
        return
    found = shell.references.find(resuming.required(context, model))
    own = arguments.read(found.model, values, preset)
    score = nw.Score()
    if target is not None:
        score = nw.no_self_intersection() * nw.match_volume(nw.Target.find(target), voxel, sigma)
    given = settings.typed(given)
    steps = given.get("steps", Mh.steps)
    method = Mh(**{"kernel": kernels.prior(), "chains": 4, "warmup": steps // 5, "keep": 100, **given})
    proposals = method.steps * method.chains
    writes = output is not None or not as_json
    with folders.own_folder(output, force) if writes else nullcontext() as folder:
        kept = None
        if folder is not None:
            kept = resuming.begun(folder, "sample", found, picture=picture, quick=quick)
        search = nw.Search(
            found.model,
            tuple(arguments.bound(found.model, own)),
            score=score,
            method=method,
            seed=nw.search.fresh(seed),
            max_memory=max_memory << 20,
        )
        with sampling_line(found.reference, proposals) as progress, resuming.told(kept, "sample"):
            result = search.run(threads=threads, progress=progress, checkpoint=kept)
        _end(result, found, folder, pictures.Pictures(picture, quick), as_json, kept)


def _end(
    result: nw.Result,
    found: shell.references.ModelReference,
    folder: Path | None,
    drawn: pictures.Pictures,
    as_json: bool,
    checkpoint: nw.Checkpoint | None,
) -> None:
    """Write the files, where there is a folder for them, and say what was found."""
    if folder is not None:
        with resuming.ended(result, checkpoint):
            _write(folder, result, found, drawn)
    if as_json:
        print(json.dumps({"runs": [shell.run_files.numbers(one) for one in result.bests]}))
    elif folder is not None:
        _summary(result, folder)
    if result.interrupted:
        if folder is not None:
            print(resuming.interrupted(folder, "sample"), file=sys.stderr if as_json else sys.stdout)
        raise typer.Exit(130)


def _write(
    folder: Path, result: nw.Result, found: shell.references.ModelReference, drawn: pictures.Pictures
) -> None:
    # The best of each chain is what can be replayed.
    bests = nw.Result(result.search, result.bests, result.seed, interrupted=result.interrupted)
    best = bests.best
    style = "ink" if result.score.window is not None else None
    names = ["samples.csv", *(["best.glb", *drawn.names(bests, style)] if best.primitives else [])]
    with shell.results.written(folder, shell.run_files.written(bests, found), names):
        write_whole(folder / "samples.csv", _table(result).encode())
        if "best.glb" in names:
            best.export(folder / "best.glb")
            drawn.write(bests, folder, style)


def _table(result: nw.Result) -> str:
    """The samples, one a line."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["chain", "proposal", "log_score", "log_prior", "value"])
    for number, draws in enumerate(result.by_chain):
        for visit, one in zip(result.visits[number], draws, strict=True):
            # What is not finite is left empty, in values too: readers of tables know no such numbers.
            scores = [finite.scalar(one.log_score), finite.scalar(one.log_prior)]
            rows.writerow([number, visit, *scores, repr(_plain(one.value))])
    return text.getvalue()


def _plain(value: Any) -> Any:
    """A value with None where a number is not finite."""
    if isinstance(value, (tuple, list)) and not hasattr(value, "_fields"):
        return type(value)(map(_plain, value))
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    return finite.scalar(value) if isinstance(value, float) else value


def _summary(result: nw.Result, folder: Path) -> None:
    print(f"{'site':<40}{'proposals':>12}{'accepted':>10}")
    for name, row in list(result.acceptance.items())[:12]:
        print(f"{name:<40}{row.proposed:>12}{row.rate:>10.2f}")
        if row.proposed >= 100 and row.outside == row.proposed:
            print(f"warning: every proposal for `{name}` was outside its support", file=sys.stderr)
    counters = result.counters
    if counters["many_proposed"]:
        share = counters["many_accepted"] / counters["many_proposed"]
        print(f"{'blocks and regenerated calls':<40}{counters['many_proposed']:>12}{share:>10.2f}")
    rate = counters["proposals"] / max(result.cpu_seconds, 1e-9)
    print(f"{counters['proposals']} proposals, {rate:,.0f} a second of processor time; seed {result.seed}")
    print(f"best: log score {result.best.log_score:.2f}; {len(result)} samples; files in {folder}")
