"""Models by reference: the list of the page, and files that are loaded again after a change."""

from __future__ import annotations

import inspect
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from niwaki import stacks
from niwaki.lang.lower import lowered
from niwaki.lang.models import Model
from niwaki.shell import references
from niwaki.shell.references import ModelReference, find
from niwaki.studio.messages import ModelInfo, Parameter
from niwaki.studio.problems import CommandError
from niwaki.studio.worker.loading import loading

#: The prefix of references of the package's structures.
STACK = "stack:"

#: Files that were named at the start, with their references: no other file is run for its models.
named: dict[Path, str] = {}

#: Folders that were named at the start, with all symbolic links resolved: files below them may be run.
folders: list[Path] = []

_loaded: dict[str, tuple[object, ModelReference]] = {}


def reference(name: str) -> ModelReference:
    """Return the model of a reference; load its file again if the file has changed.

    Raises
    ------
    CommandError
        `unnamed-file`.
    """
    place = Path(name.rpartition(":")[0] or name)
    stamp: object = None
    if place.suffix == ".py":
        check_permission(place)
    if place.suffix == ".py" and place.is_file():
        status = place.stat()
        stamp = status.st_mtime_ns, status.st_size, status.st_ino
    entry = _loaded.get(name)
    if entry is None or entry[0] != stamp:
        with loading(place) if stamp is not None else nullcontext():
            entry = _loaded[name] = (stamp, _structure(name) or find(name))
    return entry[1]


def check_permission(place: Path) -> None:
    """Refuse a file that is neither named nor below a folder that was named at the start.

    Raises
    ------
    CommandError
        `unnamed-file`.
    """
    real = place.resolve()
    if real not in named and not any(real.is_relative_to(folder) for folder in folders):
        text = (
            f"{place} was not named when the studio was started, and a model is code.\n"
            f"Read the file; then start the studio with it: niwaki studio {place.name}"
        )
        raise CommandError("unnamed-file", text)


def is_file(name: str) -> bool:
    """Whether a reference is that of a file without a function."""
    return Path(name).suffix.lower() in (".py", ".scad")


def names_in(file: str) -> list[str]:
    """Return the references of the models of a file that was named at the start."""
    place = Path(file)
    if place.suffix != ".py" or not place.is_file():
        return [file]
    with loading(place):
        return references.names_in(file)


def _structure(name: str) -> ModelReference | None:
    """Return a structure model of the package."""
    model = getattr(stacks, name.removeprefix(STACK), None) if name.startswith(STACK) else None
    return ModelReference(name, model) if isinstance(model, Model) else None


def is_structure(name: str) -> bool:
    """Whether a model makes structures that stand: it calls functions of `niwaki.stacks`."""
    if name.startswith(STACK):
        return True
    model = reference(name)
    prefix = f"{stacks.__name__}."
    functions = lowered(model.model.function).units
    return model.entry is None and any(function.__module__.startswith(prefix) for function in functions)


def info(reference: ModelReference, name: str, is_file: bool = False) -> ModelInfo:
    """Describe a model for the list of the page."""
    entry = reference.entry
    return ModelInfo(
        name,
        title=(reference.model.function.__doc__ or "").partition("\n")[0] if entry is None else entry.title,
        parameters=parameters(reference.model),
        target=None if entry is None or entry.target_name is None else f"gallery:{entry.target_name}",
        draws=None if entry is None else entry.draws,
        is_file=is_file,
        kind="structure" if name.startswith(STACK) else "scene",
    )


def parameters(model: Model[..., Any]) -> list[Parameter]:
    """List the parameters of a model, with the defaults that a page can show."""
    rows = []
    for parameter in inspect.signature(model.function).parameters.values():
        default = parameter.default
        is_required = default is inspect.Parameter.empty
        is_plain = isinstance(default, (bool, int, float, str))
        is_number = isinstance(default, int | float) and not isinstance(default, bool)
        # With `from __future__ import annotations` an annotation is a text.
        is_real = parameter.annotation in (float, "float") or isinstance(default, float)
        rows.append(
            Parameter(parameter.name, default if is_plain else None, is_required, is_number and not is_real)
        )
    return rows
