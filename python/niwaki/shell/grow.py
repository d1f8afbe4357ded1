"""`niwaki grow`: a search, written to a folder."""

from __future__ import annotations

import json
import sys
from contextlib import nullcontext
from pathlib import Path
from typing import Annotated, Any

import typer

import niwaki as nw
from niwaki import draw, gallery, search, shell, targets
from niwaki import result as results
from niwaki.errors.folders import held_folder
from niwaki.shell import controls, settings, writing
from niwaki.shell.app import Folder, Megabytes, ModelName, app
from niwaki.shell.progress import progress_line


@app.command()
@settings.with_settings(
    *settings.METHODS.values(),
    power="16, with absolute weights 1",
    particles="the model's own, or 300; of improve a third",
)
def grow(
    model: ModelName,
    target: controls.TargetFile = None,
    avoid: controls.AvoidFiles = None,
    floor: controls.Floor = None,
    within: controls.Within = None,
    match_image: controls.ImageFile = None,
    match_shadow: controls.ShadowFile = None,
    camera: controls.CameraFile = None,
    weight_image: controls.WeightFile = None,
    weight: controls.Weight = None,
    light: controls.Light = None,
    receiver: controls.ReceiverFile = None,
    window: controls.Window = None,
    pixels: controls.Pixels = None,
    voxel: controls.Voxel = None,
    sigma: controls.Sigma = None,
    rule: Annotated[str, typer.Option(help="Which parts count as intersecting: solid or surface.")] = "solid",
    method: settings.MethodName = None,
    guide: settings.GuideFile = None,
    polish: settings.Polish = None,
    polish_kernel: settings.PolishKernel = None,
    runs: Annotated[int, typer.Option(help="How many results, with seeds SEED, SEED + 1, ...")] = 1,
    seed: Annotated[int | None, typer.Option(help="Default: a new one, which run.json keeps.")] = None,
    threads: Annotated[
        int | None, typer.Option(help="Default: all cores. Results do not depend on it.")
    ] = None,
    max_steps: Annotated[int, typer.Option(help="Most calls and loop steps of one run.")] = 20_000_000,
    max_memory: Megabytes = 1024,
    output: Folder = None,
    formats: writing.Formats = None,
    scale: writing.Scale = None,
    fuse: writing.Fuse = None,
    frames: writing.Frames = None,
    size: writing.Size = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers as JSON; files are written only with -o.")
    ] = False,
    picture: Annotated[
        bool,
        typer.Option(
            "--picture/--no-picture", help="Draw best.png, sheet.png and the pictures that were matched."
        ),
    ] = True,
    **given: Any,
) -> None:
    """Grow MODEL into its target; writes best.glb (best.svg of a drawing), best.png, sheet.png and run.json."""
    found = shell.references.find(model)
    style = None if found.entry is None else found.entry.draws
    chosen = controls.Controls(
        target,
        tuple(avoid or ()),
        floor,
        within,
        match_image,
        camera,
        match_shadow,
        weight_image,
        weight,
        light,
        receiver,
        window,
        pixels,
        style is not None,
    )
    onward = settings.polish(polish, polish_kernel)
    style = style or ("ink" if chosen.is_drawing else None)
    files = writing.Files.of_flags(formats, scale, fuse, frames, size, style)
    aim = chosen.aim(found)
    score = chosen.score(found, voxel, sigma)
    drawing = chosen.drawing(found)
    start: dict[str, Any] = {}
    if drawing is not None and controls.follows(found.model):
        start = dict(zip(("x", "y", "ahead"), drawing.place(chosen.page(found)), strict=True))
    if voxel is None and target is None and aim is not None and found.entry is not None:
        voxel = found.entry.voxel
    suits = {"particles": gallery.PARTICLES} if found.entry is None else found.entry.usual
    if score.window is not None:
        suits = {**suits, "power": 1.0}
    own = settings.guide(guide, found, [*_sketches(score), *(["match_volume"] if aim else [])], method, given)
    if own is not None:
        suits, method = {**suits, **search.GUIDED}, method or "smc"
    writes = output is not None or not as_json
    # Before the search: that a folder cannot be written to must not be the news at its end.
    with held_folder(output or Path("out")) if writes else nullcontext() as folder:
        with progress_line(found.reference) as progress:
            result = nw.grow(
                found.model,
                aim,
                **start,
                score=score,
                method=settings.guided(settings.method(method, given, suits), own),
                polish=onward,
                seed=seed,
                threads=threads,
                progress=progress,
                voxel=voxel,
                sigma=0.02 if sigma is None else sigma,
                rule=rule,
                runs=runs,
                max_steps=max_steps,
                max_memory=max_memory << 20,
            )
        if folder is not None:
            _write(folder, result, found, files, picture)
    if as_json:
        print(json.dumps({"runs": [shell.run_files.numbers(sample) for sample in result]}))
    else:
        _summary(result, output or Path("out"))
    if result.interrupted:
        raise typer.Exit(130)


def _sketches(score: nw.Score) -> list[str]:
    """Names of the sketches of a score."""
    return [spec.name for spec in score.specs]


def _write(
    folder: Path,
    result: nw.Result,
    found: shell.references.ModelReference,
    files: writing.Files,
    picture: bool,
) -> None:
    """Write run.json first: the other files can be created again from it."""
    best: nw.Sample = result.best
    data = shell.run_files.written(result, found)
    if best.primitives == 0:
        with shell.results.written(folder, data, ()):
            print(
                "warning: the best run emitted nothing, so there is no mesh and no picture", file=sys.stderr
            )
        return
    pictures = ["best.png", "sheet.png", *(f"{view.kind}.png" for view in result.score.views)]
    with shell.results.written(folder, data, [*files.names, *(pictures if picture else ())]):
        if picture:
            styled: dict[str, Any] = {} if files.style is None else {"style": files.style}
            square: dict[str, Any] = {} if files.style is None else {"size": (800, 800)}
            best.save(folder / "best.png", **styled, **square)
            draw.picture.save_image(lambda: result.sheet(**styled), folder / "sheet.png")
            for view in result.score.views:
                targets.views.save_view(folder / f"{view.kind}.png", best.scene, view, **styled)
        files.write(best, folder)


def _summary(result: nw.Result, folder: Path) -> None:
    if isinstance(result.info, results.info.ImproveInfo) and len({sample.seed for sample in result}) == 1:
        print(result.info)
    for sample in result:
        print(f"{results.caption(sample)}   {sample.primitives} primitives   {sample.seconds:.2f} s")
    print(f"best: seed {result.best.seed}, log score {result.best.log_score:.2f}; files in {folder}")
