"""`niwaki guide`: training of a guide for a model, and a report about a guide."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import guides, search, shell, targets
from niwaki.errors import InputError
from niwaki.errors.files import check_place
from niwaki.guides.report import sentence
from niwaki.methods import Guide
from niwaki.search.checkpoint import resumed_seed
from niwaki.shell import controls, folders, settings
from niwaki.shell.app import ModelName, Seed, Threads, app
from niwaki.shell.progress import status_line

group = typer.Typer(
    help="Train a guide for a model, or show what a guide sees.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.add_typer(group, name="guide")

#: The last line of a stopped training.
INTERRUPTED = "interrupted; resume with the same command, and --resume {} in place of -o"


@group.command()
@settings.with_settings
def train(
    model: ModelName,
    places: Annotated[
        str,
        typer.Option(
            "--targets",
            metavar="FOLDER|NAME",
            help="A folder of drawings or of meshes, or a collection of the package's drawings, such as scribbles.",
        ),
    ],
    output: Annotated[str | None, folders.output("MODEL.guide")] = None,
    force: folders.Force = False,
    searches: Annotated[
        str | None,
        typer.Option(
            "--searches",
            metavar="LIST",
            help="Number of searches for each round, with commas. Default: 150,400.",
        ),
    ] = None,
    objective: Annotated[
        str,
        typer.Option(
            "--objective",
            metavar="examples|bound|particles",
            help="Examples: learn from the best runs of searches. Bound, particles: maximise a bound of the evidence.",
        ),
    ] = "examples",
    start: Annotated[
        str | None, typer.Option("--start", metavar="FILE", help="A guide from which the training starts.")
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(
            "--resume",
            metavar="PATH",
            help="Resume the stopped or killed training of this file. It stands in place of -o.",
        ),
    ] = None,
    mirror: Annotated[
        bool, typer.Option("--mirror/--no-mirror", help="Also learn from mirrored drawings.")
    ] = True,
    searches_ahead: Annotated[
        int | None,
        typer.Option(
            "--searches-ahead",
            metavar="N",
            help="Then train the guide's look-ahead with this number of searches, such as 2000.",
        ),
    ] = None,
    *,
    options: Annotated[dict[str, Any], controls.flags("window", "pixels", "voxel")],
    seed: Seed = None,
    threads: Threads = None,
) -> None:
    """Train a guide for MODEL in rounds of searches; each round learns from the best runs of the last."""
    reference = shell.references.find(model)
    counts = None if searches is None else settings.numbers("searches", searches, int)
    training = guides.Training() if objective == "examples" else guides.Training.bound(objective=objective)
    if resume is not None and (output is not None or force):
        raise InputError(
            "flags-exclude",
            flag="--resume",
            other="-o" if output is not None else "--force",
            reason="the file of --resume is the output",
            cure="use only one of the two",
        )
    file = resume or folders.own_file(output, f"{reference.model.name}.guide", ("guide",), force)
    place = check_place(file.with_name(f"{file.name}.checkpoint"))
    if resume is None:
        folders.refuse_existing([place], force)
        place.unlink(missing_ok=True)
    elif not place.is_file():
        raise InputError("no-checkpoint", path=place)
    seed = search.fresh(resumed_seed(seed, place))
    goals = _goals(reference, places, controls.read(options), mirror)
    start_time = time.perf_counter()
    with _training_line(reference.name) as progress, _report_interrupt(place, file):
        guide = nw.train_guide(
            reference.model,
            goals.learned,
            goals.score,
            goals.args,
            held_out=goals.held_out,
            rounds=counts,
            training=training,
            start=None if start is None else Guide.load(start),
            seed=seed,
            threads=threads,
            progress=progress,
            checkpoint=place,
        )
    if searches_ahead is not None and not guide.report.get("interrupted"):
        guide = guides.train_look_ahead(
            guide,
            reference.model,
            goals.learned,
            goals.score,
            goals.args,
            held_out=goals.held_out,
            searches=searches_ahead,
            seed=seed,
            threads=threads,
        )
    guide.save(file)
    seconds = time.perf_counter() - start_time
    print(f"{file}: {guide!r}, {len(guide.data) / 1000:.0f} kB, {seconds:.0f} s, seed {seed}")
    if any(report.get("interrupted") for report in (guide.report, guide.report.get("look_ahead", {}))):
        print(INTERRUPTED.format(file))
        raise typer.Exit(130)
    place.unlink(missing_ok=True)


@contextmanager
def _report_interrupt(checkpoint: Path, file: Path) -> Iterator[None]:
    """Print how to resume when Ctrl-C comes before there is a guide."""
    try:
        yield
    except KeyboardInterrupt:
        if not checkpoint.exists():
            raise
        print(INTERRUPTED.format(file), file=sys.stderr)
        raise typer.Exit(130) from None


@group.command()
def show(file: Annotated[str, typer.Argument(metavar="FILE", help="The file of a guide.")]) -> None:
    """Print the inputs of each choice of a guide, and how well the guide did in training."""
    guide = Guide.load(file)
    print(guide.show())
    for row in guide.report.get("rounds", ()):
        print(_line(row["number"], row["traces"], row.get("bounds", ()), row.get("summary", {})))


@dataclass(frozen=True)
class _Goals:
    """Targets for training, and targets that judge the guide."""

    learned: Sequence[Any]
    held_out: Sequence[Any]
    score: Callable[[Any], nw.Score]
    args: Callable[[Any], tuple[Any, ...]] | None = None


def _goals(
    reference: shell.references.ModelReference,
    places: str,
    options: dict[str, Any],
    mirror: bool,
) -> _Goals:
    """Return the targets of a folder or a collection; every eighth target judges the guide."""
    page = options["window"] or (None if reference.entry is None else reference.entry.window)
    if page is not None:
        drawings = _drawings(places, options["pixels"] or targets.drawings.SIDE)
        learned = [drawing for i, drawing in enumerate(drawings) if i % guides.EVERY]
        if mirror:
            learned += [drawing.mirrored() for drawing in learned]
        return _Goals(
            learned,
            drawings[:: guides.EVERY],
            lambda drawing: drawing.score(page),
            (lambda drawing: drawing.place(page)) if reference.follows else None,
        )
    files = _files(places, targets.reading.FORMATS)
    meshes = [nw.Target.load(file) for file in files]
    size = (
        options["voxel"] if options["voxel"] is not None or reference.entry is None else reference.entry.voxel
    )
    return _Goals(
        [mesh for i, mesh in enumerate(meshes) if i % guides.EVERY],
        meshes[:: guides.EVERY],
        lambda mesh: nw.no_self_intersection() * nw.match_volume(mesh, size),
    )


def _drawings(places: str, pixels: int) -> list[targets.drawing.Drawing]:
    """Return the drawings of a folder, or the drawings for training of a collection."""
    if places in targets.drawings.COLLECTIONS and not Path(places).exists():
        names = targets.drawings.names(places, "training")
        if not names:
            known = {name.partition("/")[0] for name in targets.drawings.names(use="training")}
            reason = f"all drawings of `{places}` are held out to judge guides"
            raise InputError(
                "guide-targets", name=places, reason=reason, cure=f"`--targets {', '.join(sorted(known))}`"
            )
        return [targets.drawings.drawing(name) for name in names]
    return [targets.drawing.Drawing.load(file, pixels) for file in _files(places, targets.images.FORMATS)]


def _files(places: str, formats: Sequence[str]) -> list[Path]:
    """Return the files of a folder in these formats, sorted by name; at least two."""
    folder = Path(places)
    known = ", ".join(formats)
    if not folder.is_dir():
        reason = f"the folder {folder.absolute()} does not exist"
        raise InputError("guide-targets", name=places, reason=reason, cure=f"a folder of files {known}")
    files = sorted(file for file in folder.iterdir() if file.suffix.lower() in formats)
    if len(files) < 2:
        reason = f"{len(files)} file{'' if len(files) == 1 else 's'} of the formats {known}"
        raise InputError("guide-targets", name=places, reason=reason, cure="a folder of at least two targets")
    return files


def _line(number: int, traces: int, bounds: Sequence[Any], summary: dict[str, float]) -> str:
    basis = f"a bound of {max(bound[2] for bound in bounds):.1f} nats" if bounds else f"{traces} traces"
    name = "the guide of --start" if number < 0 else f"round {number + 1}: {basis}"
    return f"{name}; held out: {sentence(summary) or 'nothing'}"


@contextmanager
def _training_line(name: str) -> Iterator[Callable[[guides.Round], None]]:
    """Print a line for each round on stderr, and show progress within a round."""
    with status_line(f"training {name}") as update:

        def show(now: guides.Round) -> None:
            if now.is_judged:
                print(_line(now.number, now.traces, now.bounds, now.summary()), file=sys.stderr)
                return
            progress = (
                f"step {now.step} of {now.steps}" if now.steps else f"{now.traces} traces of {now.wanted}"
            )
            update(f"round {now.number + 1} of {now.rounds}, {progress}")

        yield show
