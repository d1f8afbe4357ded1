"""Models by reference: what the page lists, and a file that is read again when it has changed."""

from __future__ import annotations

import inspect
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from niwaki import stacks
from niwaki.lang.lower import lowered
from niwaki.lang.models import Model
from niwaki.shell.references import ModelReference, find
from niwaki.studio.messages import ModelInfo, Parameter
from niwaki.studio.refused import Refused
from niwaki.studio.worker.loading import loading

#: What the references of our structures begin with.
STACK = "stack:"

#: Files that were named at the start, with their references: no other one is run for its models.
named: dict[Path, str] = {}

_kept: dict[str, tuple[object, ModelReference]] = {}


def reference(name: str) -> ModelReference:
    """The model of a reference; that of a file is read again when the file has changed.

    Raises
    ------
    Refused
        `unnamed-file`.
    """
    place = Path(name.rpartition(":")[0] or name)
    stamp: object = None
    if place.suffix == ".py" and place.resolve() not in named:
        text = (
            f"{place} was not named when the studio was started, and a model is code.\n"
            f"Read the file; then start the studio with it: niwaki studio {place.name}"
        )
        raise Refused("unnamed-file", text)
    if place.suffix == ".py" and place.is_file():
        found = place.stat()
        stamp = found.st_mtime_ns, found.st_size, found.st_ino
    known = _kept.get(name)
    if known is None or known[0] != stamp:
        with loading(place) if stamp is not None else nullcontext():
            known = _kept[name] = (stamp, _structure(name) or find(name))
    return known[1]


def _structure(name: str) -> ModelReference | None:
    """One of our models of structures."""
    found = getattr(stacks, name.removeprefix(STACK), None) if name.startswith(STACK) else None
    return ModelReference(name, found) if isinstance(found, Model) else None


def is_structure(name: str) -> bool:
    """Whether a model is one of structures that stand: it calls functions of `niwaki.stacks`."""
    if name.startswith(STACK):
        return True
    found = reference(name)
    own = f"{stacks.__name__}."
    called = lowered(found.model.function).units
    return found.entry is None and any(one.__module__.startswith(own) for one in called)


def info(found: ModelReference, name: str, is_file: bool = False) -> ModelInfo:
    """A model as the page lists it."""
    entry = found.entry
    return ModelInfo(
        name,
        title=(found.model.function.__doc__ or "").partition("\n")[0] if entry is None else entry.title,
        parameters=parameters(found.model),
        target=None if entry is None or entry.target_name is None else f"gallery:{entry.target_name}",
        draws=None if entry is None else entry.draws,
        is_file=is_file,
        kind="structure" if name.startswith(STACK) else "scene",
    )


def parameters(model: Model[..., Any]) -> list[Parameter]:
    """The parameters of a model by name, with defaults that a page can show."""
    found = []
    for one in inspect.signature(model.function).parameters.values():
        is_required = one.default is inspect.Parameter.empty
        plain = isinstance(one.default, (bool, int, float, str))
        found.append(Parameter(one.name, one.default if plain else None, is_required))
    return found
