"""`niwaki guide`: train a guide for a model, and show what one sees."""

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
from niwaki.shell.progress import said

group = typer.Typer(
    help="Train guides, and show what they see.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.add_typer(group, name="guide")

#: The last line of a training that was stopped.
INTERRUPTED = "interrupted; go on with the same command, and --resume {} in place of -o"


@group.command()
@settings.with_settings
def train(
    model: ModelName,
    places: Annotated[
        str,
        typer.Option(
            "--targets",
            metavar="FOLDER|NAME",
            help="A folder of drawings or of meshes; or a collection of our drawings, such as scribbles.",
        ),
    ],
    output: Annotated[str | None, folders.output("MODEL.guide")] = None,
    force: folders.Force = False,
    searches: Annotated[
        str | None,
        typer.Option(
            "--searches", metavar="LIST", help="How many for each round, with commas. Default: 150,400."
        ),
    ] = None,
    objective: Annotated[
        str,
        typer.Option(
            "--objective",
            metavar="examples|bound|particles",
            help="Learn from the best runs of searches, or from runs of its own by a bound of the evidence.",
        ),
    ] = "examples",
    start: Annotated[
        str | None, typer.Option("--start", metavar="FILE", help="A guide to go on with.")
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(
            "--resume",
            metavar="PATH",
            help="Go on with what was stopped or killed: the training of this file, in place of -o.",
        ),
    ] = None,
    mirror: Annotated[
        bool, typer.Option("--mirror/--no-mirror", help="Learn from mirrored drawings, too.")
    ] = True,
    searches_ahead: Annotated[
        int | None,
        typer.Option(
            "--searches-ahead",
            metavar="N",
            help="Then teach it to look ahead, by so many searches, such as 2000.",
        ),
    ] = None,
    *,
    asked: Annotated[dict[str, Any], controls.flags("window", "pixels", "voxel")],
    seed: Seed = None,
    threads: Threads = None,
) -> None:
    """Train a guide for MODEL: rounds of searches, each of which learns from the best runs of the last."""
    found = shell.references.find(model)
    counts = None if searches is None else settings.numbers("searches", searches, int)
    training = guides.Training() if objective == "examples" else guides.Training.bound(objective=objective)
    if resume is not None and (output is not None or force):
        raise InputError(
            "flags-exclude",
            flag="--resume",
            other="-o" if output is not None else "--force",
            reason="the training goes on in its own file",
            cure="give only one of them",
        )
    file = resume or folders.own_file(output, f"{found.model.name}.guide", ("guide",), force)
    place = check_place(file.with_name(f"{file.name}.checkpoint"))
    if resume is None:
        folders.taken([place], force)
        place.unlink(missing_ok=True)
    elif not place.is_file():
        raise InputError("no-checkpoint", path=place)
    seed = search.fresh(resumed_seed(seed, place))
    goals = _goals(found, places, controls.read(asked), mirror)
    began = time.perf_counter()
    with _shown(found.reference) as progress, _told(place, file):
        guide = nw.train_guide(
            found.model,
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
            found.model,
            goals.learned,
            goals.score,
            goals.args,
            held_out=goals.held_out,
            searches=searches_ahead,
            seed=seed,
            threads=threads,
        )
    guide.save(file)
    seconds = time.perf_counter() - began
    print(f"{file}: {guide!r}, {len(guide.data) / 1000:.0f} kB, {seconds:.0f} s, seed {seed}")
    if any(one.get("interrupted") for one in (guide.report, guide.report.get("look_ahead", {}))):
        print(INTERRUPTED.format(file))
        raise typer.Exit(130)
    place.unlink(missing_ok=True)


@contextmanager
def _told(checkpoint: Path, file: Path) -> Iterator[None]:
    """Where Ctrl-C comes before there is a guide, the last line says how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        if not checkpoint.exists():
            raise
        print(INTERRUPTED.format(file), file=sys.stderr)
        raise typer.Exit(130) from None


@group.command()
def show(file: Annotated[str, typer.Argument(metavar="FILE", help="A guide's file.")]) -> None:
    """Print what each choice of a guide sees, and how well the guide did."""
    guide = Guide.load(file)
    print(guide.show())
    for one in guide.report.get("rounds", ()):
        print(_line(one["number"], one["traces"], one.get("bounds", ()), one.get("summary", {})))


@dataclass(frozen=True)
class _Goals:
    """What to learn from, and what judges."""

    learned: Sequence[Any]
    held_out: Sequence[Any]
    score: Callable[[Any], nw.Score]
    args: Callable[[Any], tuple[Any, ...]] | None = None


def _goals(
    found: shell.references.ModelReference,
    places: str,
    asked: dict[str, Any],
    mirror: bool,
) -> _Goals:
    """The targets of a folder or a collection; each eighth judges."""
    page = asked["window"] or (None if found.entry is None else found.entry.window)
    if page is not None:
        drawings = _drawings(places, asked["pixels"] or targets.drawings.SIDE)
        learned = [one for i, one in enumerate(drawings) if i % guides.EVERY]
        if mirror:
            learned += [one.mirrored() for one in learned]
        return _Goals(
            learned,
            drawings[:: guides.EVERY],
            lambda one: one.score(page),
            (lambda one: one.place(page)) if found.follows else None,
        )
    files = _files(places, targets.reading.FORMATS)
    meshes = [nw.Target.load(file) for file in files]
    size = asked["voxel"] if asked["voxel"] is not None or found.entry is None else found.entry.voxel
    return _Goals(
        [one for i, one in enumerate(meshes) if i % guides.EVERY],
        meshes[:: guides.EVERY],
        lambda one: nw.no_self_intersection() * nw.match_volume(one, size),
    )


def _drawings(places: str, pixels: int) -> list[targets.drawing.Drawing]:
    """The drawings of a folder, or those of a collection that are for training."""
    if places in targets.drawings.COLLECTIONS and not Path(places).exists():
        names = targets.drawings.names(places, "training")
        if not names:
            known = {one.partition("/")[0] for one in targets.drawings.names(use="training")}
            reason = f"all of `{places}` are held out, so that guides can be judged by them"
            raise InputError(
                "guide-targets", name=places, reason=reason, cure=f"`--targets {', '.join(sorted(known))}`"
            )
        return [targets.drawings.drawing(name) for name in names]
    return [targets.drawing.Drawing.load(file, pixels) for file in _files(places, targets.images.FORMATS)]


def _files(places: str, formats: Sequence[str]) -> list[Path]:
    """The files of a folder that have one of these formats, by name; at least two."""
    folder = Path(places)
    known = ", ".join(formats)
    if not folder.is_dir():
        reason = f"there is no folder {folder.absolute()}"
        raise InputError("guide-targets", name=places, reason=reason, cure=f"a folder of files {known}")
    files = sorted(one for one in folder.iterdir() if one.suffix.lower() in formats)
    if len(files) < 2:
        reason = f"{len(files)} file{'' if len(files) == 1 else 's'} of the formats {known}"
        raise InputError("guide-targets", name=places, reason=reason, cure="a folder of at least two targets")
    return files


def _line(number: int, traces: int, bounds: Sequence[Any], summary: dict[str, float]) -> str:
    what = f"a bound of {max(one[2] for one in bounds):.1f} nats" if bounds else f"{traces} traces"
    name = "the guide that was given" if number < 0 else f"round {number + 1}: {what}"
    return f"{name}; held out: {sentence(summary) or 'nothing'}"


@contextmanager
def _shown(name: str) -> Iterator[Callable[[guides.Round], None]]:
    """A line for each round on stderr, and progress within a round."""
    with said(f"training {name}") as tell:

        def show(now: guides.Round) -> None:
            if now.is_judged:
                print(_line(now.number, now.traces, now.bounds, now.summary()), file=sys.stderr)
                return
            what = f"step {now.step} of {now.steps}" if now.steps else f"{now.traces} traces of {now.wanted}"
            tell(f"round {now.number + 1} of {now.rounds}, {what}")

        yield show
