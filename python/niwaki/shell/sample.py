"""`niwaki sample`: Markov chains, written to a folder."""

from __future__ import annotations

import csv
import io
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import kernels, shell, targets
from niwaki.draw import finite
from niwaki.errors.files import write_whole
from niwaki.errors.folders import held_folder
from niwaki.errors.schema import fitted
from niwaki.errors.settings import MAX_MEMORY
from niwaki.methods import Mh
from niwaki.shell import arguments, controls, folders, pictures, resuming, settings, writing
from niwaki.shell.app import Megabytes, Seed, Threads, app
from niwaki.shell.progress import sampling_line

#: What can be written alone.
ALONE = ("csv", "json", "glb", "png")


@app.command()
@settings.with_settings
def sample(
    context: typer.Context,
    what: resuming.What,
    wish: Annotated[dict[str, Any], controls.flags("target", "voxel", "sigma")],
    seed: Seed = None,
    threads: Threads = None,
    max_memory: Megabytes = MAX_MEMORY >> 20,
    *,
    out: folders.Out,
    drawn: pictures.Pictures,
    given: Annotated[
        dict[str, Any],
        settings.of_methods(Mh, chains="4", warmup="a fifth of all", keep="100", kernel="prior()"),
    ],
) -> None:
    """Sample MODEL by Markov chains; writes samples.csv and run.json, and best.glb, best.png, sheet.png for scenes."""
    if what.resume is not None:
        search, found, drawn, kept = resuming.left(
            context, what.resume, "sample", lambda flags: fitted(flags, pictures.Pictures)
        )
        with held_folder(what.resume) as folder:
            result = _searched(search, found, threads, kept)
            _end(result, found, folder, drawn, out, kept)
        return
    found, own = resuming.model_of(context, what)
    asks = found.asked(wish) if wish["target"] is not None else []
    given = settings.typed(given)
    steps = given.get("steps", Mh.steps)
    method = Mh(**{"kernel": kernels.prior(), "chains": 4, "warmup": steps // 5, "keep": 100, **given})
    alone = out.alone(ALONE)
    with out.folder(alone) as folder:
        checkpoint: nw.Checkpoint | None = None
        if folder is not None:
            checkpoint = resuming.begun(folder, "sample", found, **asdict(drawn))
        search = nw.Search(
            found.model,
            tuple(arguments.bound(found.model, own)),
            score=targets.asks.score(asks),
            method=method,
            seed=nw.search.fresh(seed),
            max_memory=max_memory << 20,
        )
        result = _searched(search, found, threads, checkpoint)
        _end(result, found, folder, drawn, out, checkpoint, alone)


def _searched(
    search: nw.Search,
    found: shell.references.ModelReference,
    threads: int | None,
    checkpoint: nw.Checkpoint | None,
) -> nw.Result:
    """Carry it out, with a line about its progress."""
    proposals = search.method.steps * search.method.chains if isinstance(search.method, Mh) else 0
    with sampling_line(found.reference, proposals) as progress, resuming.told(checkpoint, "sample"):
        return search.run(threads=threads, progress=progress, checkpoint=checkpoint)


def _end(
    result: nw.Result,
    found: shell.references.ModelReference,
    folder: Path | None,
    drawn: pictures.Pictures,
    out: folders.Out,
    checkpoint: nw.Checkpoint | None,
    alone: Path | None = None,
) -> None:
    """Write the files, where there is a folder for them, or the one `alone`, and say what was found."""
    if alone is not None:
        _write_one(alone, result, found, drawn)
    elif folder is not None:
        with resuming.ended(result, checkpoint):
            _write(folder, result, found, drawn)
    if out.as_json:
        print(json.dumps({"runs": [shell.run_files.numbers(one) for one in result.bests]}))
    elif place := alone or folder:
        _summary(result, place)
    if result.interrupted:
        if folder is not None:
            print(resuming.interrupted(folder, "sample"), file=out.stream)
        raise typer.Exit(130)


def _write_one(
    place: Path, result: nw.Result, found: shell.references.ModelReference, drawn: pictures.Pictures
) -> None:
    """Write one file, by its suffix: the table, or what shows the best."""
    if place.suffix.lower() == ".csv":
        write_whole(place, _table(result).encode())
        return
    bests = nw.Result(result.search, result.bests, result.seed, interrupted=result.interrupted)
    files = writing.Files(style=_style(result))
    shell.results.write_one(place, shell.run_files.written(bests, found), bests.best, files, drawn)


def _style(result: nw.Result) -> str | None:
    """The style of its pictures: ink, of a drawing."""
    return None if result.score.window is None else "ink"


def _write(
    folder: Path, result: nw.Result, found: shell.references.ModelReference, drawn: pictures.Pictures
) -> None:
    # The best of each chain is what can be replayed.
    bests = nw.Result(result.search, result.bests, result.seed, interrupted=result.interrupted)
    best = bests.best
    style = _style(result)
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


def _summary(result: nw.Result, place: Path) -> None:
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
    print(f"best: log score {result.best.log_score:.2f}; {len(result)} samples; {folders.said(place)}")
