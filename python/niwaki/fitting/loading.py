"""The generator of what a person gives to `nw.fit`, and of the data that a worker process gets."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.fitting.commands import CommandGenerator
from niwaki.fitting.functions import FunctionGenerator
from niwaki.fitting.generator import Generator
from niwaki.fitting.openscad import ScadGenerator, scad

#: How generators are made again, by the kinds of their recipes.
KINDS: dict[str, Callable[[Mapping[str, Any]], Generator]] = {
    "function": FunctionGenerator.of_recipe,
    "command": CommandGenerator.of_recipe,
    "scad": ScadGenerator.of_recipe,
}


def generator_of(model: Any) -> Generator:
    """Return the generator of a function, a file of OpenSCAD, or a generator itself.

    Raises
    ------
    InputError
        `bad-setting`: nothing that can be fitted; or an error about its parameters.
    """
    if isinstance(model, Generator):
        return model
    if isinstance(model, str | PathLike) and Path(model).suffix.lower() == ".scad":
        return scad(model)
    if isinstance(model, Callable) and not isinstance(model, type):  # type: ignore[arg-type]
        return FunctionGenerator(model)
    raise InputError(
        "bad-setting",
        name="model",
        found=repr(model)[:80],
        expected="a function that returns a mesh, `nw.scad(...)` or `nw.command(...)`",
        suggestion="`nw.fit(bracket, goal)`",
    )


def generator_of_recipe(recipe: Mapping[str, Any]) -> Generator:
    """Make a generator again from its data, in a worker process."""
    if recipe["kind"] not in KINDS:
        # A kind of a package above names its module.
        module, _, name = str(recipe["kind"]).partition(":")
        generator: Generator = getattr(import_module(module), name).of_recipe(recipe)
        return generator
    return KINDS[recipe["kind"]](recipe)
