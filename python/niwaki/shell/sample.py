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
from niwaki.shell import arguments, controls, folders, formats, pictures, resume, settings
from niwaki.shell.app import Megabytes, Seed, Threads, app
from niwaki.shell.progress import sampling_line

#: Suffixes of files that can be written without a folder.
SINGLE_FILES = ("csv", "json", "glb", "png")


@app.command()
@settings.with_settings
def sample(
    context: typer.Context,
    source: resume.Source,
    options: Annotated[dict[str, Any], controls.flags("target", "voxel", "sigma")],
    seed: Seed = None,
    threads: Threads = None,
    max_memory: Megabytes = MAX_MEMORY >> 20,
    *,
    out: folders.Destination,
    images: pictures.Pictures,
    method_settings: Annotated[
        dict[str, Any],
        settings.of_methods(Mh, chains="4", warmup="a fifth of all", keep="100", kernel="prior()"),
    ],
) -> None:
    """Sample MODEL by Markov chains. Writes samples.csv and run.json; for scenes also best.glb, best.png, sheet.png."""
    if source.resume is not None:
        search, reference, images, stored = resume.stopped_search(
            context, source.resume, "sample", lambda flags: fitted(flags, pictures.Pictures)
        )
        with held_folder(source.resume) as folder:
            result = _run(search, reference, threads, stored)
            _end(result, reference, folder, images, out, stored)
        return
    reference, values = resume.model_of(context, source)
    asks = reference.terms(options) if options["target"] is not None else []
    typed = settings.typed(method_settings)
    steps = typed.get("steps", Mh.steps)
    method = Mh(**{"kernel": kernels.prior(), "chains": 4, "warmup": steps // 5, "keep": 100, **typed})
    single_file = out.single_file(SINGLE_FILES)
    with out.folder(single_file) as folder:
        checkpoint: nw.Checkpoint | None = None
        if folder is not None:
            checkpoint = resume.new_checkpoint(folder, "sample", reference, **asdict(images))
        search = nw.Search(
            reference.model,
            tuple(arguments.bound(reference.model, values)),
            score=targets.asks.score(asks),
            method=method,
            seed=nw.search.fresh(seed),
            max_memory=max_memory << 20,
        )
        result = _run(search, reference, threads, checkpoint)
        _end(result, reference, folder, images, out, checkpoint, single_file)


def _run(
    search: nw.Search,
    reference: shell.references.ModelReference,
    threads: int | None,
    checkpoint: nw.Checkpoint | None,
) -> nw.Result:
    """Run the search, with a line about its progress."""
    proposals = search.method.steps * search.method.chains if isinstance(search.method, Mh) else 0
    with sampling_line(reference.name, proposals) as progress, resume.report_interrupt(checkpoint, "sample"):
        return search.run(threads=threads, progress=progress, checkpoint=checkpoint)


def _end(
    result: nw.Result,
    reference: shell.references.ModelReference,
    folder: Path | None,
    images: pictures.Pictures,
    out: folders.Destination,
    checkpoint: nw.Checkpoint | None,
    single_file: Path | None = None,
) -> None:
    """Write the files to the folder or the single file, if there is one, and print a summary."""
    if single_file is not None:
        _write_one(single_file, result, reference, images)
    elif folder is not None:
        with resume.remove_when_done(result, checkpoint):
            _write(folder, result, reference, images)
    if out.as_json:
        print(json.dumps({"runs": [shell.run_files.numbers(best) for best in result.bests]}))
    elif place := single_file or folder:
        _summary(result, place)
    if result.interrupted:
        if folder is not None:
            print(resume.interrupt_message(folder, "sample"), file=out.stream)
        raise typer.Exit(130)


def _write_one(
    place: Path, result: nw.Result, reference: shell.references.ModelReference, images: pictures.Pictures
) -> None:
    """Write one file by its suffix: the table of samples, or a file of the best run."""
    if place.suffix.lower() == ".csv":
        write_whole(place, _table(result).encode())
        return
    bests = nw.Result(result.search, result.bests, result.seed, interrupted=result.interrupted)
    files = formats.Files(style=_style(result))
    shell.results.write_one(place, shell.run_files.written(bests, reference), bests.best, files, images)


def _style(result: nw.Result) -> str | None:
    """Return the style of the result's pictures: ink for a drawing, None for a scene in space."""
    return None if result.score.window is None else "ink"


def _write(
    folder: Path, result: nw.Result, reference: shell.references.ModelReference, images: pictures.Pictures
) -> None:
    # run.json has the best of each chain.
    bests = nw.Result(result.search, result.bests, result.seed, interrupted=result.interrupted)
    best = bests.best
    style = _style(result)
    names = ["samples.csv", *(["best.glb", *images.names(bests, style)] if best.primitives else [])]
    with shell.results.results_folder(folder, shell.run_files.written(bests, reference), names):
        write_whole(folder / "samples.csv", _table(result).encode())
        if "best.glb" in names:
            best.export(folder / "best.glb")
            images.write(bests, folder, style)


def _table(result: nw.Result) -> str:
    """Return the samples as CSV, one a line."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["chain", "proposal", "log_score", "log_prior", "value"])
    for number, draws in enumerate(result.by_chain):
        for visit, sample in zip(result.visits[number], draws, strict=True):
            # A number that is not finite is left empty, also in values: readers of tables know no such numbers.
            scores = [finite.scalar(sample.log_score), finite.scalar(sample.log_prior)]
            rows.writerow([number, visit, *scores, repr(_plain(sample.value))])
    return text.getvalue()


def _plain(value: Any) -> Any:
    """Return a value with None in place of numbers that are not finite."""
    if isinstance(value, (tuple, list)) and not hasattr(value, "_fields"):
        return type(value)(map(_plain, value))
    if isinstance(value, dict):
        return {name: _plain(part) for name, part in value.items()}
    return finite.scalar(value) if isinstance(value, float) else value


def _summary(result: nw.Result, place: Path) -> None:
    labels = result.model.labels
    rows = list(result.acceptance.items())[:12]
    shown = [labels.site(row.function, row.site) for _, row in rows]
    wide = max([len("choice"), *map(len, shown)]) + 3
    print(f"{'choice':<{wide}}{'site':<36}{'proposals':>12}{'accepted':>10}")
    for label, (name, row) in zip(shown, rows, strict=True):
        print(f"{label:<{wide}}{name:<36}{row.proposed:>12}{row.rate:>10.2f}")
        if row.proposed >= 100 and row.outside == row.proposed:
            print(f"warning: all proposals for `{name}` were outside its support", file=sys.stderr)
    counters = result.counters
    if counters["many_proposed"]:
        share = counters["many_accepted"] / counters["many_proposed"]
        print(f"{'blocks and regenerated calls':<{wide + 36}}{counters['many_proposed']:>12}{share:>10.2f}")
    rate = counters["proposals"] / max(result.cpu_seconds, 1e-9)
    print(f"{counters['proposals']} proposals, {rate:,.0f} a second of processor time; seed {result.seed}")
    print(f"best: log score {result.best.log_score:.2f}; {len(result)} samples; {folders.location(place)}")
