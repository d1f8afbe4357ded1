"""`niwaki grow`: a search, written to a folder."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from niwaki.shell.app import Folder, ModelName, app, made_folder, progress_line

if TYPE_CHECKING:
    from niwaki.finding import Found
    from niwaki.result import Result, Sample
    from niwaki.target import Target


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
    with progress_line(found.reference, particles) as progress:
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


def _write(
    output: Path, result: Result, found: Found, settings: dict[str, Any], target: str, picture: bool
) -> None:
    from niwaki import run_files

    folder = made_folder(output)
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
