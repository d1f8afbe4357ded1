"""Models by reference: what the page lists, and a file that is read again when it has changed."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

from niwaki import gallery, targets
from niwaki.lang.models import Model
from niwaki.shell.references import ModelReference, find
from niwaki.studio.messages import Answer, ListModels, Load, ModelInfo, Parameter

_kept: dict[str, tuple[object, ModelReference]] = {}


def reference(name: str) -> ModelReference:
    """The model of a reference; that of a file is read again when the file has changed."""
    place = Path(name.rpartition(":")[0] or name)
    stamp: object = None
    if place.suffix == ".py" and place.is_file():
        found = place.stat()
        stamp = found.st_mtime_ns, found.st_size, found.st_ino
    known = _kept.get(name)
    if known is None or known[0] != stamp:
        known = _kept[name] = (stamp, find(name))
    return known[1]


def listed(job: ListModels) -> Answer:
    """The models that can be chosen: those of the files first."""
    infos = []
    for file in job.files:
        infos.append(info(reference(file), file, is_file=True))
    for entry in gallery.entries():
        # A model without a target, a drawing or a score of its own makes no scene to look at.
        if entry.target_name is not None or entry.draws is not None:
            infos.append(info(ModelReference(entry.name, entry.model, entry), entry.name))
    return Answer(models=infos, targets=[f"gallery:{name}" for name in targets.examples.TARGETS])


def loaded(job: Load) -> Answer:
    """A model, compiled so that its errors are seen."""
    found = reference(job.reference)
    found.model.program()
    is_file = found.entry is None
    return Answer(models=[info(found, job.reference, is_file)])


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
    )


def parameters(model: Model[..., Any]) -> list[Parameter]:
    """The parameters of a model by name, with defaults that a page can show."""
    found = []
    for one in inspect.signature(model.function).parameters.values():
        is_required = one.default is inspect.Parameter.empty
        plain = isinstance(one.default, (bool, int, float, str))
        found.append(Parameter(one.name, one.default if plain else None, is_required))
    return found
