"""`niwaki init`: a folder to begin with: a model, its target, requirements, a test that grows it, and a README.

With `--generator` the model calls a generator that somebody else wrote.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.errors.files import ensure_folder, write_whole
from niwaki.fitting.loading import generator_of
from niwaki.fitting.models import model_text
from niwaki.shell import folders
from niwaki.shell.app import app
from niwaki.shell.requirements import NAME
from niwaki.words import box, wedge

MODEL = '''"""A house: walls, a roof on them, a chimney beside them."""

from niwaki import box, emit, flip, model, uniform, wedge


@model
def house(storeys: int = 2):
    width, depth = uniform(1.5, 4.0), uniform(1.0, 3.0)
    height = walls(storeys, width, depth)
    roof(width, depth, height)
    if flip(0.5):
        chimney(width, height)


def walls(storeys, width, depth):
    storey = uniform(0.6, 1.2)
    for k in range(storeys):
        emit(box((0, (k + 0.5) * storey, 0), (width, storey, depth)))
    return storeys * storey


def roof(width, depth, height):
    rise = uniform(0.3, 1.5)
    emit(wedge((0, height + rise / 2, 0), (width, rise, depth)))


def chimney(width, height):
    side = uniform(0.2, 0.5)
    top = height + uniform(0.2, 1.0)
    emit(box((width / 2 + side / 2, top / 2, 0), (side, top, side)))
'''

REQUIREMENTS = """# What every result has to keep; lengths are in units of the scene. A person owns this file.
covered = 0.9          # the least share of the target that a result fills
height = [2.0, 3.0]    # the least and the largest height
stands = true          # whether a result has to stand on its lowest points
thinnest = 0.002       # the least thickness of a part
collisions = false     # whether parts may intersect
"""

TEST = '''"""The model grows into its target, and keeps its requirements."""

from pathlib import Path

import niwaki as nw
from house import house

FOLDER = Path(__file__).parent


def test_the_house_grows_into_its_target():
    target = nw.Target.load(FOLDER / "target.obj")
    result = nw.grow(house, target, rounds=4, seed=1)
    keep = nw.Keep.load(FOLDER / "requirements.toml")
    assert keep.unmet(result.best) == []
'''

README = """# House

`house.py` is a model: a Python function with random choices. Niwaki searches the choices.

    niwaki show house.py                        runs of the model, side by side
    niwaki check house.py                       its choices, and how often its requirements hold
    niwaki grow house.py --target target.obj    a search; the result is in out/
    niwaki studio house.py                      the same in the browser
    niwaki mcp .                                the same for a program, by the Model Context Protocol
    python -m pytest                            the test
"""


WRAPPED = """# {name}

`{file}` is a model: its choices are the parameters of `{place}`, which it calls. Change their ranges in it.

    niwaki show {file}                        runs of the model, side by side
    niwaki grow {file} --target target.stl    a search; the result is in out/
    niwaki studio {file}                      the same in the browser: sliders, holding, ten results that differ
"""


@app.command()
def init(
    folder: Annotated[Path, typer.Argument(metavar="NEW-FOLDER", help="A new folder, or an empty one.")],
    generator: Annotated[
        str | None,
        typer.Option(
            "--generator",
            metavar="GENERATOR",
            help="Write a model that calls a function, file.py:function, or an OpenSCAD file: box.scad.",
        ),
    ] = None,
    force: folders.Force = False,
) -> None:
    """Write a folder to begin with: a model, its target, requirements, a test, a README."""
    if generator is None:
        texts = {"house.py": MODEL, NAME: REQUIREMENTS, "test_house.py": TEST, "README.md": README}
        last, next_ = ["target.obj"], "grow house.py --target target.obj"
    else:
        texts, last = _calling(generator, folder), list[str]()
        next_ = f"studio {next(iter(texts))}"
    present = [name for name in (*texts, *last) if (folder / name).exists()]
    if present and not force:
        raise InputError("already-there", path=folder / present[0], count=len(present), cure="add `--force`")
    ensure_folder(folder)
    for name, text in texts.items():
        write_whole(folder / name, text.encode())
    if generator is None:
        shapes = [box((0, 0.85, 0), (2.4, 1.7, 1.6)), wedge((0, 2.1, 0), (2.4, 0.8, 1.6))]
        Scene([("walls", [shapes[0]]), ("roof", [shapes[1]])]).export(folder / "target.obj")
    for name in (*texts, *last):
        print(folder / name)
    print(f"next: cd {folder} && niwaki {next_}")


def _calling(reference: str, folder: Path) -> dict[str, str]:
    """Return the texts of a folder whose model calls a generator."""
    generator = generator_of(reference)
    if generator.space is None:
        reason = "it draws its parameters while it runs; a model needs their ranges in its signature"
        raise InputError("unknown-model", name=reference, reason=reason)
    path, colon, name = reference.rpartition(":") if ".py:" in reference else (reference, "", "")
    place = Path(os.path.relpath(path, folder)).as_posix() + colon + name
    file = f"{generator.name}_model.py"
    readme = WRAPPED.format(name=generator.name, file=file, place=place)
    return {file: model_text(generator, place), "README.md": readme}
