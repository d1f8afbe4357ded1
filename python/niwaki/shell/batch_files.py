"""The TOML file of a batch: a model, seeds, and flags of `niwaki grow` and arguments of the model, fixed or varied.

    model = "spaceship"
    seeds = 250

    [grow]
    voxel = 0.3

    [vary.grow]
    particles = [50, 100]

    [vary.arguments]
    width = [2.0, 3.0]

A file name is first looked up in the folder of the TOML file.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from difflib import get_close_matches
from itertools import product
from pathlib import Path
from typing import Any, get_type_hints

from msgspec import Struct

from niwaki import Search, batches
from niwaki.errors import InputError
from niwaki.errors.schema import Unfit, fitted, inside, shown
from niwaki.inputs import text_of
from niwaki.inputs.texts import toml_of
from niwaki.shell import arguments, controls, references, request, settings
from niwaki.targets import asks


class Vary(Struct, frozen=True, forbid_unknown_fields=True):
    """Lists of values for the flags and arguments that vary."""

    grow: dict[str, Any] = {}
    arguments: dict[str, Any] = {}


class SpecFile(Struct, frozen=True, forbid_unknown_fields=True):
    """The fields of the file."""

    model: str
    seeds: int | list[int]
    grow: dict[str, Any] = {}
    arguments: dict[str, Any] = {}
    vary: Vary = Vary()


#: Flags that name a file, which may lie in the folder of the batch file.
FILES = (*asks.FILES, "guide")

#: Flags of `niwaki grow` that a batch file does not have, because the batch sets them.
_OF_BATCH = ("runs", "seed")


@dataclass(frozen=True)
class Batch:
    """The contents of a batch file.

    Attributes
    ----------
    name
        The name of the file, without its suffix.
    table
        The searches.
    seeds
        The number of seeds, or a list of them.
    """

    name: str
    table: batches.Table
    seeds: int | list[int]


def load(place: Path) -> Batch:
    """Read a batch file; the Python file of its model is run.

    Raises
    ------
    InputError
        The file is not a batch, or it names a model, flag or value that cannot be used.
    """
    try:
        contents: SpecFile = fitted(toml_of(text_of(place, "preset", "a batch"), place), SpecFile)
        with inside(".grow"):
            fixed = _flags(contents.grow)
        with inside(".vary.grow"):
            varied = {name.replace("-", "_"): values for name, values in contents.vary.grow.items()}
            for name, values in varied.items():
                for value in _value_list(name, values):
                    _flags({name: value})
        with inside(".vary.arguments"):
            for name, values in contents.vary.arguments.items():
                _value_list(name, values)
        twice = {*fixed} & {*varied} or {*contents.arguments} & {*contents.vary.arguments}
        if twice:
            raise Unfit(f"$.vary..{min(twice)}", "a name that is not also fixed", "a fixed name")
    except Unfit as error:
        raise InputError("bad-spec", path=place, reason=str(error)) from error
    reference = references.find(_beside(place, contents.model))
    searches, labels = [], []
    for flags in _each(varied):
        row_flags = _flags({**contents.grow, **flags})
        for row in _each(contents.vary.arguments):
            model_arguments = arguments.fitting(reference.model, {**contents.arguments, **row})
            searches.append(_search_of(place, reference, row_flags, model_arguments))
            labelled = {**flags, **row}
            labels.append({name: batches.label(value) for name, value in labelled.items()})
    return Batch(place.stem, batches.Table(searches, labels), contents.seeds)


def _each(axes: Mapping[str, list[Any]]) -> Iterator[dict[str, Any]]:
    """Yield each combination of one value for each name."""
    return (dict(zip(axes, values, strict=True)) for values in product(*axes.values()))


def _value_list(name: str, values: Any) -> list[Any]:
    """Return the values of a name that varies; refuse anything but a list with values."""
    if not isinstance(values, list) or not values:
        raise Unfit(f"$.{name}", "a list with at least one value", shown(values))
    return values


def _flags(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return flags by their names in Python, each with its type; a list of numbers becomes a text with commas."""
    values: dict[str, Any] = {}
    kinds = _kinds()
    for name, value in table.items():
        field = name.replace("-", "_")
        if field not in kinds:
            near = get_close_matches(field, kinds, n=1)
            expected = f"`{near[0]}`" if near else "a flag of `niwaki grow` that decides a search"
            raise Unfit(f"$.{name}", expected, f"`{name}`")
        kind = kinds[field]
        if kind == str | None and isinstance(value, list):
            value = ",".join(map(str, value))
        elif kind == str | None and isinstance(value, (int, float)) and not isinstance(value, bool):
            value = str(value)
        with inside(f".{name}"):
            values[field] = fitted(value, kind)
    return values


def _kinds() -> dict[str, Any]:
    """Return the type of each flag that decides a search."""
    hints = get_type_hints(request.SearchFlags)
    search_flags = {
        field.name: hints[field.name] for field in fields(request.SearchFlags) if field.name not in _OF_BATCH
    }
    return {**settings.kinds(), **{name: controls.kind(name) for name in asks.OPTIONS}, **search_flags}


def _search_of(
    place: Path,
    reference: references.ModelReference,
    flags: Mapping[str, Any],
    model_arguments: Mapping[str, Any],
) -> Search:
    """Return the search of flags of `niwaki grow` and arguments of the model."""
    rest = dict(flags)
    for name in FILES:
        value = rest.get(name)
        if isinstance(value, str):
            rest[name] = _beside(place, value)
        elif value is not None:
            rest[name] = [_beside(place, file) for file in value]
    options = {name: rest.pop(name) for name in asks.OPTIONS if name in rest}
    names = [field.name for field in fields(request.SearchFlags) if field.name in rest]
    search_flags = request.SearchFlags(seed=0, **{name: rest.pop(name) for name in names})
    terms = controls.terms(options, reference)
    return request.search_of(reference, terms, search_flags, rest, model_arguments)


def _beside(place: Path, name: str) -> str:
    """Return the path of a file in the folder of the batch file, if it exists there; else the name."""
    path = place.resolve().parent / name
    return str(path) if path.exists() or path.with_name(path.name.partition(":")[0]).exists() else name
