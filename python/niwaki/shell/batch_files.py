"""The TOML file of a batch: model, seeds, and flags of `niwaki grow` and arguments of the model, fixed or varied.

    model = "spaceship"
    seeds = 250

    [grow]
    voxel = 0.3

    [vary.grow]
    particles = [50, 100]

    [vary.arguments]
    width = [2.0, 3.0]

Files are looked for beside this one first.
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
from niwaki.shell import arguments, asking, controls, references, settings
from niwaki.targets import asks


class Vary(Struct, frozen=True, forbid_unknown_fields=True):
    """What varies: lists of values."""

    grow: dict[str, Any] = {}
    arguments: dict[str, Any] = {}


class SpecFile(Struct, frozen=True, forbid_unknown_fields=True):
    """The file."""

    model: str
    seeds: int | list[int]
    grow: dict[str, Any] = {}
    arguments: dict[str, Any] = {}
    vary: Vary = Vary()


#: Flags that name a file, which lies beside the batch's.
FILES = (*asks.FILES, "guide")

#: What `niwaki grow` decides for a whole batch.
_WHOLE = ("runs", "seed")


@dataclass(frozen=True)
class Batch:
    """A batch as its file describes it.

    Attributes
    ----------
    name
        Of the file, without its suffix.
    table
        The searches.
    seeds
        A number of seeds, or the seeds.
    """

    name: str
    table: batches.Table
    seeds: int | list[int]


def load(place: Path) -> Batch:
    """Read the file of a batch; the file of its model is run.

    Raises
    ------
    InputError
        It is none, or something that it names cannot be used.
    """
    try:
        read: SpecFile = fitted(toml_of(text_of(place, "preset", "a batch"), place), SpecFile)
        with inside(".grow"):
            fixed = _flags(read.grow)
        with inside(".vary.grow"):
            varied = {name.replace("-", "_"): values for name, values in read.vary.grow.items()}
            for name, values in varied.items():
                for value in _some(name, values):
                    _flags({name: value})
        with inside(".vary.arguments"):
            for name, values in read.vary.arguments.items():
                _some(name, values)
        twice = {*fixed} & {*varied} or {*read.arguments} & {*read.vary.arguments}
        if twice:
            raise Unfit(f"$.vary..{min(twice)}", "what is not fixed elsewhere", "a name that is")
    except Unfit as error:
        raise InputError("bad-spec", path=place, reason=str(error)) from error
    found = references.find(_beside(place, read.model))
    searches, labels = [], []
    for flags in _each(varied):
        own_flags = _flags({**read.grow, **flags})
        for own in _each(read.vary.arguments):
            given = arguments.fitting(found.model, {**read.arguments, **own})
            searches.append(_searched(place, found, own_flags, given))
            named = {**flags, **own}
            labels.append({name: batches.label(value) for name, value in named.items()})
    return Batch(place.stem, batches.Table(searches, labels), read.seeds)


def _each(axes: Mapping[str, list[Any]]) -> Iterator[dict[str, Any]]:
    """Each combination of one value for each name."""
    return (dict(zip(axes, values, strict=True)) for values in product(*axes.values()))


def _some(name: str, values: Any) -> list[Any]:
    """Values of what varies."""
    if not isinstance(values, list) or not values:
        raise Unfit(f"$.{name}", "a list with at least one value", shown(values))
    return values


def _flags(table: Mapping[str, Any]) -> dict[str, Any]:
    """Flags by their names in Python, each of its type; lists of numbers as the flag is typed."""
    found: dict[str, Any] = {}
    kinds = _kinds()
    for name, value in table.items():
        plain = name.replace("-", "_")
        if plain not in kinds:
            near = get_close_matches(plain, kinds, n=1)
            expected = f"`{near[0]}`" if near else "a flag of `niwaki grow` that decides a search"
            raise Unfit(f"$.{name}", expected, f"`{name}`")
        kind = kinds[plain]
        if kind == str | None and isinstance(value, list):
            value = ",".join(map(str, value))
        elif kind == str | None and isinstance(value, (int, float)) and not isinstance(value, bool):
            value = str(value)
        with inside(f".{name}"):
            found[plain] = fitted(value, kind)
    return found


def _kinds() -> dict[str, Any]:
    """The type of each flag that decides a search."""
    hints = get_type_hints(asking.How)
    how = {one.name: hints[one.name] for one in fields(asking.How) if one.name not in _WHOLE}
    return {**settings.kinds(), **{name: controls.kind(name) for name in asks.OPTIONS}, **how}


def _searched(
    place: Path, found: references.ModelReference, flags: Mapping[str, Any], given: Mapping[str, Any]
) -> Search:
    """The search of flags, as `niwaki grow` has them, and arguments."""
    own = dict(flags)
    for name in FILES:
        value = own.get(name)
        if isinstance(value, str):
            own[name] = _beside(place, value)
        elif value is not None:
            own[name] = [_beside(place, one) for one in value]
    wish = {name: own.pop(name) for name in asks.OPTIONS if name in own}
    how = asking.How(seed=0, **{one.name: own.pop(one.name) for one in fields(asking.How) if one.name in own})
    return asking.searched(found, controls.asked(wish, found), how, own, given)


def _beside(place: Path, name: str) -> str:
    """A file beside the batch's, where it is there; else the name."""
    own = place.resolve().parent / name
    return str(own) if own.exists() or own.with_name(own.name.partition(":")[0]).exists() else name
