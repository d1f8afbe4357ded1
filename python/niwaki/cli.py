"""The shell's door: `niwaki grow`, `replay`, `models` and `check`.

What a person asked for goes to files and stdout, how it goes to stderr. Exit codes: 0 done, 1 a model that does not
compile (`check`), 2 an error with a message, 130 stopped by Ctrl-C (what was found is written first).
"""

from __future__ import annotations

import json
import math
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from niwaki.errors import ModelError, NiwakiError

if TYPE_CHECKING:
    from niwaki.finding import Found
    from niwaki.result import Result, Sample
    from niwaki.search import Progress
    from niwaki.target import Target

app = typer.Typer(
    name="niwaki",
    help="Grow procedural models into the shapes you ask for.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

ModelName = Annotated[str, typer.Argument(metavar="MODEL", help="A gallery name, or file.py:function.")]
Folder = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="DIR", help="Where files go; default: out.")
]


def main() -> NoReturn:
    """Run the command line; errors that we raise on purpose have no traceback."""
    warnings.showwarning = _warned  # type: ignore[assignment]
    try:
        app(standalone_mode=True)
    except NiwakiError as error:
        print(error, file=sys.stderr)
        raise SystemExit(2) from None
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        raise SystemExit(130) from None
    raise SystemExit(0)


def _warned(message: Warning | str, category: type[Warning], *_: Any) -> None:
    print(f"warning: {message}", file=sys.stderr)


@app.command()
def grow(
    model: ModelName,
    target: Annotated[
        str | None,
        typer.Option(
            "--target", metavar="FILE", help="A mesh (OBJ, STL, PLY, GLB); default: the model's own."
        ),
    ] = None,
    particles: Annotated[
        int | None,
        typer.Option(
            "-n", "--particles", help="Size of the population; default: what suits the model, or 300."
        ),
    ] = None,
    order: Annotated[str, typer.Option(help="stochastic or depth-first.")] = "stochastic",
    weights: Annotated[str, typer.Option(help="ratio or absolute.")] = "ratio",
    temper: Annotated[
        float | None, typer.Option(help="Sharpening of the search; default: 16, with absolute weights 1.")
    ] = None,
    voxel: Annotated[
        float | None, typer.Option(metavar="SIZE", help="Cell size; default: what suits model or target.")
    ] = None,
    sigma: Annotated[float, typer.Option(help="Strictness of the match; smaller is stricter.")] = 0.02,
    rule: Annotated[str, typer.Option(help="What intersects: solid or surface.")] = "solid",
    runs: Annotated[int, typer.Option(help="How many results, with seeds SEED, SEED + 1, ...")] = 1,
    seed: Annotated[int | None, typer.Option(help="Default: a fresh one, which is written down.")] = None,
    threads: Annotated[
        int | None, typer.Option(help="Default: all cores. Results do not depend on it.")
    ] = None,
    resampling: Annotated[
        str, typer.Option(help="systematic, residual, stratified or multinomial.")
    ] = "systematic",
    ess: Annotated[
        float | None, typer.Option(help="Resample below this share of effective particles; default: always.")
    ] = None,
    max_steps: Annotated[int, typer.Option(help="Most calls and loop steps of one run.")] = 20_000_000,
    output: Folder = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as JSON; files are written only with -o.")
    ] = False,
    picture: Annotated[
        bool, typer.Option("--picture/--no-picture", help="Draw best.png and sheet.png.")
    ] = True,
) -> None:
    """Grow MODEL into a target; writes best.glb, best.png, sheet.png and run.json."""
    from niwaki import infer
    from niwaki.finding import find
    from niwaki.gallery import PARTICLES

    found = find(model)
    aim, reference = _target(found, target)
    if voxel is None and target is None and found.entry is not None:
        voxel = found.entry.voxel
    if particles is None:
        particles = found.entry.particles if found.entry is not None else PARTICLES
    settings: dict[str, Any] = {
        "particles": particles,
        "order": order,
        "weights": weights,
        "temper": infer.default_temper(weights) if temper is None else temper,
        "resampling": resampling,
        "ess": ess,
        "voxel": voxel,
        "sigma": sigma,
        "rule": rule,
        "runs": runs,
        "max_steps": max_steps,
    }
    with _shown(found.reference, particles) as progress:
        result = infer.grow(found.model, aim, seed=seed, threads=threads, progress=progress, **settings)
    settings["voxel"] = result.score.settings["voxel"]
    if output is not None or not as_json:
        _write(output or Path("out"), result, found, settings, reference, picture)
    if as_json:
        from niwaki.run_files import numbers

        print(json.dumps({"runs": [numbers(sample) for sample in result]}))
    else:
        _summary(result, output or Path("out"))
    if result.interrupted:
        raise typer.Exit(130)


@app.command()
def replay(
    run: Annotated[Path, typer.Argument(metavar="RUN.JSON", help="What `niwaki grow` wrote.")],
    output: Folder = None,
    picture: Annotated[bool, typer.Option("--picture/--no-picture", help="Draw best.png.")] = True,
) -> None:
    """Make the best mesh of a search again, byte for byte."""
    from niwaki.run_files import load, replayed, target_hash

    data = load(run)
    sample = replayed(data)
    folder = _folder(output or Path("out"))
    _say(sample.export(folder / "best.glb"))
    if picture and sample.primitives:
        aim = _same_target(data)
        if aim is not None and target_hash(aim) != data["target"]["hash"]:
            print("warning: the target has changed since this run; its ghost is today's", file=sys.stderr)
        _say(sample.save(folder / "best.png", aim))


@app.command()
def models() -> None:
    """List the gallery: name, target, what it makes."""
    from niwaki.gallery import entries

    for entry in entries():
        print(f"{entry.name:<16} {entry.target_name or '-':<16} {entry.title}")


@app.command()
def check(
    model: ModelName,
    core: Annotated[bool, typer.Option("--core", help="Print the core form.")] = False,
    bytecode: Annotated[bool, typer.Option("--bytecode", help="Print the bytecode.")] = False,
) -> None:
    """Compile MODEL and report what it is made of; exit 1 when it does not compile."""
    from niwaki.finding import find

    found = find(model)
    start = time.perf_counter()
    try:
        made = found.model.core()
    except ModelError as error:
        print(error, file=sys.stderr)
        raise typer.Exit(1) from None
    lowered = time.perf_counter() - start
    program = found.model.program()
    if core:
        print(made.text, end="")
    if bytecode:
        print(program.disassemble(), end="")
    if core or bytecode:
        return
    own = [row for row in program.functions if "/" not in row[0]]
    print(f"{found.reference}: compiled in {1e3 * (lowered + program.seconds):.1f} ms")
    print(f"  constants   {len(made.constants)}")
    print(f"  functions   {len(own)}")
    width = max(len(name) for name, _, _ in own)
    for name, kind, sites in own:
        inner = [row[2] for row in program.functions if row[0].startswith(f"{name}/")]
        total = sites + sum(inner)
        what = "pure" if kind == "pure" else f"{total} site{'' if total == 1 else 's'}"
        print(f"    {name:<{width}}  {what}")
    print(f"  choices     {len(program.choices)}")
    for name, component, line in program.choices:
        print(f"    {name.split('/')[0]:<{width}}  {component:<20} line {line}")


def _target(found: Found, given: str | None) -> tuple[Target, str]:
    """The target and how to find it again."""
    from niwaki.errors import InputError
    from niwaki.target import Target

    if given is not None:
        return Target.load(given), str(Path(given).resolve())
    if found.entry is None or found.entry.target_name is None:
        raise InputError("no-target", name=found.reference)
    own = found.entry.target()
    assert own is not None
    return own, f"gallery:{found.entry.target_name}"


def _same_target(data: dict[str, Any]) -> Target | None:
    """The target of a search that was written down, where it is still there."""
    from niwaki.gallery import named_target
    from niwaki.target import Target

    reference = str(data["target"]["reference"])
    if reference.startswith("gallery:"):
        return named_target(reference.removeprefix("gallery:"))
    if Path(reference).is_file():
        return Target.load(reference)
    print(f"warning: the target {reference} is not there; the picture is without its ghost", file=sys.stderr)
    return None


def _folder(place: Path) -> Path:
    from niwaki.file_errors import FileError

    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError("file-unwritable", place, reason=error.strerror or str(error)) from error
    return place


def _write(
    output: Path, result: Result, found: Found, settings: dict[str, Any], target: str, picture: bool
) -> None:
    from niwaki import run_files

    folder = _folder(output)
    run_files.save(folder / "run.json", run_files.written(result, found, settings, target))
    best: Sample = result.best
    if best.primitives == 0:
        print("warning: the best run emitted nothing, so there is no mesh and no picture", file=sys.stderr)
        return
    best.export(folder / "best.glb")
    if picture:
        from niwaki.draw.picture import save_image

        best.save(folder / "best.png")
        save_image(lambda: result.sheet(), folder / "sheet.png")


def _summary(result: Result, folder: Path) -> None:
    from niwaki.result import caption

    for sample in result:
        print(f"{caption(sample)}   {sample.primitives} primitives   {sample.seconds:.2f} s")
    print(f"best: seed {result.best.seed}, log score {result.best.log_score:.2f}; files in {folder}")


def _say(place: Path) -> None:
    print(place)


@contextmanager
def _shown(name: str, particles: int) -> Iterator[Callable[[Progress], None]]:
    """A line on stderr that tells how far the search is; nothing where stderr is not a terminal."""
    from rich.console import Console

    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda _: None
        return
    with console.status(f"growing {name}") as status:

        def show(now: Progress) -> None:
            best = f"{now.best:.2f}" if math.isfinite(now.best) else "-"
            status.update(
                f"growing {name}: run {now.run + 1} of {now.runs}, barrier {now.done}, "
                f"{now.ended} of {particles} ended, best {best}   (Ctrl-C keeps the best so far)"
            )

        yield show


if __name__ == "__main__":
    main()
