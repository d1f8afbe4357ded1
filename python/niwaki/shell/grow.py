"""`niwaki grow`: a search, written to a folder."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

import niwaki as nw
from niwaki import _engine, shell
from niwaki import result as results
from niwaki.errors import InputError
from niwaki.errors.folders import held_folder
from niwaki.errors.schema import fitted
from niwaki.requirements import Keep
from niwaki.result import parts
from niwaki.shares import percent
from niwaki.shell import (
    controls,
    evaluations,
    folders,
    formats,
    origin,
    pictures,
    request,
    requirements,
    resume,
    selection,
    settings,
)
from niwaki.shell.app import Threads, Verbose, app, counted
from niwaki.shell.clock import Clock
from niwaki.shell.progress import progress_line
from niwaki.targets.asks import DRAWN, OPTIONS


@app.command()
@settings.with_settings
def grow(
    context: typer.Context,
    source: resume.Source,
    options: controls.Options,
    search_flags: request.SearchFlags,
    origin_flags: origin.Flags,
    out: folders.Destination,
    flags: formats.Flags,
    images: pictures.Pictures,
    threads: Threads = None,
    verbose: Verbose = False,
    *,
    method_settings: Annotated[
        dict[str, Any],
        settings.of_methods(
            *settings.METHODS.values(),
            power="16, with absolute weights 1",
            particles="the model's own, or 300; a third of it for improve",
        ),
    ],
) -> None:
    """Grow MODEL into its target. Writes best.glb (best.svg for a drawing), best.png, sheet.png and run.json.

    Exit code 1: no result keeps requirements.toml beside MODEL.
    """
    clock = Clock()
    if source.resume is not None:
        search, reference, contents, stored = resume.stopped_search(
            context, source.resume, "grow", Contents.of_data
        )
        with held_folder(source.resume) as folder:
            _, spent, _ = evaluations.sized(search, is_free=False)
            rules = requirements.beside(reference)
            kept = _run(search, reference, rules, threads, stored, clock, verbose, spent)
            _end(*kept, reference, rules, folder, contents, out, stored, clock, verbose)
        return
    patterns, values = origin.read(origin_flags)
    earlier = None
    with clock.part("compile"):
        if source.model is None:
            # The model of the earlier result, as it was.
            earlier = origin.Origin.of_flags(origin_flags, patterns, values)
        if earlier is None:
            reference, arguments = resume.model_of(context, source)
        else:
            reference, arguments = earlier.reference, {}
            if source.values or source.preset:
                reason = "a result keeps its model without the names of the arguments"
                raise InputError("flag-alone", flag="NAME=VALUE", other="MODEL", reason=reason)
        reference.model.program()
    single_file = out.single_file(formats.SINGLE_FILES, **flags.of_folders)
    earlier = earlier or origin.Origin.of_flags(origin_flags, patterns, values)
    has_goals = any(_is_given(context, name) for name in OPTIONS)
    asks = controls.terms(options, reference) if earlier is None or has_goals else []
    drawn = [sketch for sketch, _ in asks]
    if earlier is not None and not has_goals:
        drawn = [call.function for call in earlier.sample.search.score.asks]
    style = reference.style or ("ink" if any(sketch in DRAWN for sketch in drawn) else None)
    files = formats.Files.of_flags(flags, style, single_file)
    with clock.part("target"):
        # A value is more definite than a pattern that matches its choice, too.
        hold = {**(earlier.held if earlier else {}), **parts.held(values, None, (), reference.model)}
        if earlier is None or has_goals:
            search = request.search_of(
                reference, asks, search_flags, method_settings, arguments, hold or None
            )
        else:
            search = earlier.search_again(reference, search_flags, method_settings, arguments, hold or None)
    rules = requirements.beside(reference)
    if rules is not None:
        search = replace(search, score=rules.aims(search.score))
    is_free = earlier is None and not set(settings.typed(method_settings)) & {
        "particles",
        "rounds",
        "seconds",
    }
    search, spent, note = evaluations.sized(search, is_free)
    if note:
        print(note, file=sys.stderr)
    diverse = method_settings["diverse"]
    selection.exported(flags.export, search_flags.runs if diverse is None else diverse)
    contents = Contents(files, images, flags.export, None if earlier is None else earlier.data())
    # The folder comes before the search: a search must not end with a folder that cannot be written to.
    with out.folder(single_file) as folder:
        if folder is not None:
            # An earlier search in this folder may have failed.
            (folder / pictures.IMPOSSIBLE).unlink(missing_ok=True)
        with _draw_impossible(search, folder if images.wanted and style is None else None, images.quick):
            checkpoint: nw.Checkpoint | None = None
            conflicts: list[str] = []
            if earlier is not None and earlier.reroll:
                with clock.part("search"):
                    result = earlier.reroll_parts(search, method_settings["particles"], threads)
            else:
                if folder is not None:
                    checkpoint = resume.new_checkpoint(folder, "grow", reference, **asdict(contents))
                result, conflicts = _run(search, reference, rules, threads, checkpoint, clock, verbose, spent)
        _end(
            result,
            conflicts,
            reference,
            rules,
            folder,
            contents,
            out,
            checkpoint,
            clock,
            verbose,
            single_file,
        )


def _is_given(context: typer.Context, name: str) -> bool:
    """Whether a flag is on the command line."""
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def _run(
    search: nw.Search,
    reference: shell.references.ModelReference,
    rules: Keep | None,
    threads: int | None,
    checkpoint: nw.Checkpoint | None,
    clock: Clock,
    verbose: bool,
    spent: evaluations.Evaluations,
) -> tuple[nw.Result, list[str]]:
    """Run the search, with a line about its progress, until results keep the requirements beside the model."""
    method = search.method
    count = getattr(method, "diverse", None) or search.runs

    def attempt(seed: int, candidates: int) -> nw.Result:
        if seed == search.seed:
            return search.run(threads=threads, progress=progress, checkpoint=checkpoint)
        print(f"no result keeps {requirements.NAME}: another search with seed {seed}", file=sys.stderr)
        further = replace(search, seed=seed)
        if isinstance(method, nw.improve):
            further = replace(further, runs=1, method=replace(method, diverse=candidates))
        return further.run(threads=threads, progress=progress)

    with clock.part("search"):
        line = progress_line(reference.model.name, verbose, spent)
        with line as progress, resume.report_interrupt(checkpoint, "grow"):
            return requirements.keeping(rules, attempt, search.seed, count)


@contextmanager
def _draw_impossible(search: nw.Search, folder: Path | None, quick: bool) -> Iterator[None]:
    """Draw a picture into the folder that shows why every run is impossible."""
    try:
        yield
    except InputError as error:
        if error.code == "everything-impossible" and folder is not None:
            if line := pictures.impossible(search, folder, quick):
                print(line, file=sys.stderr)
        raise


@dataclass(frozen=True)
class Contents:
    """The contents of a folder of results, also stored in a checkpoint.

    Attributes
    ----------
    files
        The files of the best result and of exported results.
    drawn
        The pictures.
    export
        Numbers of results, as on the command line.
    origin
        The earlier result from which the search starts.
    """

    files: formats.Files
    drawn: pictures.Pictures
    export: str | None
    origin: dict[str, Any] | None

    @classmethod
    def of_data(cls, data: dict[str, Any]) -> Contents:
        """Read the contents from the data of `dataclasses.asdict`."""
        formats.Files.of_data(data["files"])
        contents: Contents = fitted(data, cls)
        return contents


def _end(
    result: nw.Result,
    conflicts: list[str],
    reference: shell.references.ModelReference,
    rules: Keep | None,
    folder: Path | None,
    contents: Contents,
    out: folders.Destination,
    checkpoint: nw.Checkpoint | None,
    clock: Clock,
    verbose: bool,
    single_file: Path | None = None,
) -> None:
    """Write the files to the folder or the single file, if there is one, and print a summary."""
    place = single_file or folder
    if place is not None:
        data = shell.run_files.written(result, reference)
        if contents.origin is not None:
            data["origin"] = contents.origin
        if single_file is not None:
            with clock.part("files"):
                images = pictures.Pictures(quick=contents.drawn.quick)
                shell.results.write_one(single_file, data, result.best, contents.files, images)
        else:
            with resume.remove_when_done(result, checkpoint):
                _write(place, result, data, contents, clock)
    unmet = [] if rules is None else rules.unmet(result.best)
    if out.as_json:
        runs = [shell.run_files.numbers(sample) | {"seed": sample.seed} for sample in result]
        if rules is not None:
            runs = [run | {"unmet": rules.unmet(sample)} for run, sample in zip(runs, result, strict=True)]
        print(json.dumps({"runs": runs} | ({"conflicts": conflicts} if conflicts else {})))
    elif place is not None:
        _summary(result, place, clock, verbose)
    if result.interrupted:
        if folder is not None:
            print(resume.interrupt_message(folder, "grow"), file=out.stream)
        raise typer.Exit(130)
    if unmet:
        for text in unmet:
            typer.secho(f"required: {text}", fg="red", err=True)
        for text in conflicts:
            typer.secho(f"cannot be kept: {text}", fg="red", err=True)
        raise typer.Exit(1)


def _write(
    folder: Path,
    result: nw.Result,
    data: dict[str, Any],
    contents: Contents,
    clock: Clock,
) -> None:
    """Write run.json first, from which the other files can be written again, then those files."""
    best: nw.Sample = result.best
    if best.primitives == 0:
        with shell.results.results_folder(folder, data, ()):
            print(
                "warning: the best run emitted nothing, so there is no mesh and no picture", file=sys.stderr
            )
        return
    files, images = contents.files, contents.drawn
    numbers = selection.exported(contents.export, len(result))
    selected = [(number, result[number - 1]) for number in numbers if result[number - 1].primitives]
    names = [*files.names(), *(name for number, _ in selected for name in files.names(number))]
    with shell.results.results_folder(folder, data, [*names, *images.names(result, files.style)]):
        with clock.part("pictures"):
            images.draft(result, folder, files.style)
        with clock.part("files"):
            files.write(best, folder)
            for number, sample in selected:
                files.write(sample, folder, number)
        # Last, since they take longest: Ctrl-C keeps the drafts and the files.
        with clock.part("pictures"):
            images.write(result, folder, files.style)


#: The share of the target below which a result is called a failure.
LITTLE = 0.1


def _too_little(result: nw.Result) -> str:
    """Return a warning that the best run covers little of its target, with the constraint that stopped most runs."""
    fit = result.best.fit
    if fit is None or fit.covered >= LITTLE:
        return ""
    text = f"warning: the best run covers only {percent(fit.covered)} of the target" + _sizes(result)
    blame = getattr(getattr(result.info, "losses", None), "blame", ())
    if not blame:
        return text
    first = blame[0]
    cure = (_engine.SKETCHES.get(first.constraint) or ("", ""))[1]
    if first.constraint == "no_self_intersection":
        cure += ', or let limbs bend with `joint="round"`; `--rule none` allows all overlaps'
    return f"{text}: most lost runs ended because {first.text(result.model.labels)}\n  {cure}"


#: How much larger a target is than a run if the two are of different scales.
OTHER_SCALE = 3.0


def _sizes(result: nw.Result) -> str:
    """Return lines about a run of another scale than its target, and about cells larger than its parts are thick."""
    boxes = np.array([shape.aabb() for part in result.best.parts for shape in part.shapes])
    cells = [call.arguments["voxel"] for call in result.search.score.asks if call.function == "match_volume"]
    target = result.search.score.target
    if not len(boxes) or not cells or target is None:
        return ""
    text, extent = "", float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())
    goal, thick = float(target.size.max()), float(np.median((boxes[:, 1] - boxes[:, 0]).min(axis=1)))
    if goal > OTHER_SCALE * extent:
        text += f"\n  the run is {extent:.3g} long, and the target {goal:.3g}: are both in the same unit?"
    if thick < cells[0]:
        text += f"\n  half of its parts are thinner than a cell of {cells[0]:.3g}: try `--voxel {0.5 * thick:.2g}`"
    return text


def _summary(result: nw.Result, place: Path, clock: Clock, verbose: bool) -> None:
    if warning := _too_little(result):
        typer.secho(warning, fg="red", err=True)
    info, seeds = result.info, {sample.seed for sample in result}
    if verbose and len(seeds) == 1 and isinstance(info, results.info.ImproveInfo | results.info.EmulateInfo):
        print(info)
        if isinstance(info, results.info.ImproveInfo):
            print(f"spent: {info.bill}")
    losses = getattr(result.info, "losses", None)
    if losses is not None and losses.causes:
        print(losses.text(result.model.labels))
    for number, sample in enumerate(result, 1):
        print(f"{results.caption(sample, number, verbose)}   {counted(sample.primitives, 'primitive')}")
    print(f"best: #{result.samples.index(result.best) + 1}; {folders.location(place)}")
    print(clock)
