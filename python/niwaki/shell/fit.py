"""`niwaki fit`: the parameters of a model that somebody else wrote, in a folder that the same command continues."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

import niwaki as nw
from niwaki import targets
from niwaki.draw import picture
from niwaki.errors.files import write_whole
from niwaki.errors.folders import held_folder
from niwaki.errors.settings import bad
from niwaki.fitting.blend import BlendGenerator, blend
from niwaki.fitting.fronts import front_camera
from niwaki.fitting.generator import Generator
from niwaki.fitting.loading import BLEND, generator_of
from niwaki.shell import controls, folders, origin, pictures, settings
from niwaki.shell.app import Json, Limit, Seed, Workers, app, counted
from niwaki.shell.progress import duration, status_line
from niwaki.targets import asks

#: The options of a goal: those of scenes in space.
OPTIONS = (
    *("target", "voxel", "sigma", "volume_weight", "avoid", "floor", "within"),
    *("match_image", "match_shadow", "camera", "weight_image", "weight", "light", "receiver"),
)


#: Mesh files in which Blender leaves z up, and the options that are solids.
Z_UP, SOLIDS = (".stl", ".ply", ".3mf"), ("target", "avoid")

ModelFile = Annotated[
    str,
    typer.Argument(
        metavar="GENERATOR",
        help="file.py:function, which is run, an OpenSCAD file: box.scad, or a Blender file with Geometry Nodes: "
        "chair.blend, chair.blend:Object, chair.blend:Object:Modifier.",
    ),
]


@app.command()
@settings.with_settings
def fit(
    model: ModelFile,
    options: Annotated[dict[str, Any], controls.flags(*OPTIONS)],
    evaluations: Annotated[
        int, typer.Option("--evaluations", metavar="N", help="Evaluations in all, with those of the folder.")
    ] = 300,
    seconds: Annotated[
        float | None,
        typer.Option("--seconds", metavar="SECONDS", help="Begin no evaluation after so many seconds."),
    ] = None,
    workers: Workers = None,
    limit: Limit = 60.0,
    align: Annotated[
        bool, typer.Option("--align", help="Search the place, turn and size of the mesh, too.")
    ] = False,
    hold: Annotated[
        list[str] | None,
        typer.Option(
            "--hold",
            metavar="NAME=VALUE",
            help="Hold the socket NAME of a Blender file at VALUE; without =VALUE at its value there. Repeatable.",
        ),
    ] = None,
    seed: Seed = None,
    output: Annotated[str | None, folders.output("the model's name and -fit")] = None,
    as_json: Json = False,
    *,
    images: pictures.Pictures,
) -> None:
    """Fit the parameters of GENERATOR to a target. Writes fit.json, table.csv, best.glb, best.png, sheet.png.

    The same command goes on where it stopped.
    """
    generator = generator_named(model, hold or ())
    score = goal(generator, options)
    folder = None if as_json and output is None else Path(output or f"{generator.name}-fit")
    with status_line(f"fitting {generator.name}") as show:
        result = nw.fit(
            generator,
            score,
            evaluations,
            seconds=seconds,
            workers=workers,
            folder=folder,
            seed=seed,
            limit=limit,
            align=align,
            progress=lambda now: show(progress_text(now)),
        )
    if folder is not None:
        with held_folder(folder):
            _write(result, folder, images)
    if as_json:
        print(json.dumps(result.numbers()))
    else:
        _summary(result, folder)
    if result.interrupted:
        print("stopped: the same command goes on from here", file=sys.stderr)
        raise typer.Exit(130)


def generator_named(reference: str, hold: Sequence[str] = ()) -> Generator:
    """Return the generator of `file.py:function`, of an OpenSCAD file, or of an object of a Blender file.

    Parameters
    ----------
    reference
        The words of the command line.
    hold
        Sockets of a Blender file that are held: their names, or NAME=VALUE.

    Raises
    ------
    InputError
        `unknown-model`.
    """
    if match := BLEND.fullmatch(reference):
        names, values = origin.read(origin.Flags(hold=list(hold)))
        return blend(match[1], match[2], match[3], hold={**dict.fromkeys(names), **values}, up="y")
    if hold:
        raise bad(
            "--hold", hold[0], "a Blender file, whose sockets it names", "its own range, in the model's file"
        )
    return generator_of(reference)


def goal(generator: Generator, options: dict[str, Any]) -> nw.Score:
    """Return the score of the flags; an image without a camera is seen from the front.

    Beside a Blender file, meshes stand up that Blender writes with z up: y is up in pictures and GLB files.
    """
    values = controls.read(options)
    if isinstance(generator, BlendGenerator):
        values = {name: _stood(value) if name in SOLIDS else value for name, value in values.items()}
    if values.get("match_image") is not None and values.get("camera") is None:
        values["camera"] = front_camera(generator, targets.images.silhouette(values["match_image"]))
    terms = asks.sketches_of(values, name=generator.name)
    # One mesh is one part, which intersects nothing.
    return asks.score([term for term in terms if term[0] != "no_self_intersection"])


def _stood(value: Any) -> Any:
    """Turn a mesh file, or several, in which z is up."""
    if isinstance(value, list | tuple):
        return [_stood(entry) for entry in value]
    if not isinstance(value, str | PathLike) or Path(value).suffix.lower() not in Z_UP:
        return value
    mesh = nw.Target.load(value)
    x, y, z = mesh.vertices.T
    return nw.Target(np.stack([x, z, -y], axis=1), mesh.faces, mesh.name)


def progress_text(now: nw.fitting.FitProgress) -> str:
    """Describe the progress of a fit."""
    best = f"{now.best:.2f}" if math.isfinite(now.best) else "-"
    failed = f", {now.failed} failed" if now.failed else ""
    left = "" if now.seconds_left is None else f", {duration(now.seconds_left)} left"
    return f"{now.done} of {now.evaluations}{failed}, best {best}, {now.seconds_each:.2g} s each{left}"


def _write(result: nw.fitting.FitResult, folder: Path, images: pictures.Pictures) -> None:
    """Write the files of a folder."""
    result.table(folder / "table.csv")
    best = result.best
    data = json.dumps(result.numbers(), indent=1, default=float) + "\n"
    write_whole(folder / "fit.json", data.encode())
    if not len(best.scene):
        return
    best.export(folder / "best.glb")
    if images.wanted:
        draft: dict[str, Any] = {"samples": 1, "size": pictures.DRAFT} if images.quick else {}
        best.save(folder / "best.png", **draft)
        cells: dict[str, Any] = {"samples": 1, "size": pictures.CELL} if images.quick else {}
        shown = [sample for sample in result.variants(10) if len(sample.scene)]
        picture.save_image(lambda: result.sheet(shown, **cells), folder / "sheet.png")


def _summary(result: nw.fitting.FitResult, folder: Path | None) -> None:
    best = result.best
    width = max(len(name) for name in best.parameters)
    for name, value in best.parameters.items():
        print(f"{name:<{width}}  {value:.6g}" if isinstance(value, float) else f"{name:<{width}}  {value}")
    shares = "" if best.covered is None else f"   {targets.fit.Fit(best.covered, best.outside or 0.0)}"
    union = "" if best.iou is None else f"   IoU {np.floor(1000 * best.iou) / 1000:.3f}"
    print(f"log score {best.log_score:.2f}{shares}{union}")
    failed = sum(result.failures.values())
    lost = f", {failed} failed" if failed else ""
    print(f"{counted(len(result), 'evaluation')}{lost}, seed {result.loop.seed}, files in {folder}")
    for text, number in list(result.failures.items())[:3]:
        print(f"failed {number} times: {text}")
