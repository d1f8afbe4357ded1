"""The generator of what a person gives to `nw.fit`, and of the data that a worker process gets."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from importlib import import_module
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.fitting.blend import blend
from niwaki.fitting.commands import CommandGenerator
from niwaki.fitting.functions import FunctionGenerator
from niwaki.fitting.generator import Generator
from niwaki.fitting.openscad import ScadGenerator, scad
from niwaki.inputs.modules import run_file
from niwaki.lang.models import Model

#: A Blender file, with its object and its modifier.
BLEND = re.compile(r"(.*\.blend)(?::([^:]+))?(?::([^:]+))?", re.IGNORECASE)

#: How generators are made again, by the kinds of their recipes.
KINDS: dict[str, Callable[[Mapping[str, Any]], Generator]] = {
    "function": FunctionGenerator.of_recipe,
    "command": CommandGenerator.of_recipe,
    "scad": ScadGenerator.of_recipe,
}


def generator_of(model: Any) -> Generator:
    """Return the generator of what a person has.

    Parameters
    ----------
    model
        A function that returns a mesh; the path of an OpenSCAD file; `file.py:function`; a Blender file, with y up, and
        perhaps its object and modifier: `chair.blend:Chair:Legs`; or a generator itself.

    Raises
    ------
    InputError
        `bad-setting`: nothing that can be fitted; `unknown-model`: no such function; or an error about its parameters.
    """
    if isinstance(model, Generator):
        return model
    if isinstance(model, str | PathLike):
        return _in_file(fspath(model))
    if isinstance(model, Callable) and not isinstance(model, type):  # type: ignore[arg-type]
        return FunctionGenerator(model)
    raise InputError(
        "bad-setting",
        name="model",
        found=repr(model)[:80],
        expected="a function that returns a mesh, `nw.scad(...)`, `nw.blend(...)` or `nw.command(...)`",
        suggestion="`nw.fit(bracket, goal)`",
    )


def _in_file(reference: str) -> Generator:
    if reference.lower().endswith(".scad"):
        return scad(reference)
    if match := BLEND.fullmatch(reference):
        return blend(*match.groups(), up="y")
    place, _, name = reference.rpartition(":") if not reference.endswith(".py") else (reference, "", "")
    if not place.endswith(".py") or not Path(place).is_file():
        reason = "write file.py:function, or the path of an OpenSCAD or Blender file"
        if place.endswith(".py"):
            reason = f"there is no file {Path(place).absolute()}"
        raise InputError("unknown-model", name=reference, reason=reason)
    module, _ = run_file(Path(place).resolve())
    functions = {
        key: value
        for key, value in vars(module).items()
        if callable(value)
        and not isinstance(value, type)
        and getattr(value, "__module__", "") == module.__name__
        and not key.startswith("_")
    }
    if not name and len(functions) == 1:
        (name,) = functions
    if name not in functions:
        listed = ", ".join(functions) or "no function"
        raise InputError("unknown-model", name=reference, reason=f"{place} defines {listed}")
    function = functions[name]
    if isinstance(function, Model):
        reason = f"`{name}` is a model of Niwaki's own: `niwaki grow {reference}` searches it"
        raise InputError("unknown-model", name=reference, reason=reason)
    return FunctionGenerator(function)


def generator_of_recipe(recipe: Mapping[str, Any]) -> Generator:
    """Make a generator again from its data, in a worker process."""
    if recipe["kind"] not in KINDS:
        # A kind of a package above names its module.
        module, _, name = str(recipe["kind"]).partition(":")
        generator: Generator = getattr(import_module(module), name).of_recipe(recipe)
        return generator
    return KINDS[recipe["kind"]](recipe)
