"""References to models: a name of the gallery, or `file.py:function`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from niwaki.errors import InputError
from niwaki.gallery import Entry, entries, entry
from niwaki.inputs.modules import run_file
from niwaki.lang.models import Model
from niwaki.targets import asks
from niwaki.targets.sketches import Ask


@dataclass(frozen=True)
class ModelReference:
    """A model with the name by which it can be loaded again.

    Attributes
    ----------
    name : str
        A gallery name, or `path:function` with the absolute path.
    model : Model
        The model.
    entry : Entry or None
        The model's entry in the gallery.
    file_hash : str or None
        SHA-256 of the bytes of its file, which were run; None for a model of the gallery.
    """

    name: str
    model: Model[..., Any]
    entry: Entry | None = None
    file_hash: str | None = None

    def terms(self, options: Mapping[str, Any]) -> list[Ask]:
        """Return the terms of the score for options (`niwaki.targets.asks`); without a match, the gallery's."""
        if self.entry is None:
            return asks.sketches_of(options, name=self.name)
        return asks.sketches_of(options, self.entry.asks, self.entry.window, self.name)

    @property
    def style(self) -> str | None:
        """The drawing style of the model; None for models in space."""
        return None if self.entry is None else self.entry.draws

    @property
    def follows(self) -> bool:
        """Whether the model starts where a drawing starts: it has the parameters x, y and ahead."""
        return set(self.model.core().parameters) >= {"x", "y", "ahead"}

    def start(self, terms: Iterable[Ask]) -> dict[str, Any]:
        """Return the arguments of a model that follows a drawing; no arguments for any other model."""
        return asks.start(terms) if self.follows else {}


def find(reference: str) -> ModelReference:
    """Find a model by its gallery name or `file.py:function`; the file is run."""
    place, colon, name = reference.rpartition(":")
    if reference.endswith(".py"):
        place, colon, name = reference, ":", ""
    if colon and place.endswith(".py"):
        return _in_file(reference, Path(place), name)
    if reference.lower().endswith(".scad"):
        reason = (
            f"an OpenSCAD file is no model: `niwaki fit {reference}` fits its parameters, and "
            f"`niwaki init NEW-FOLDER --generator {reference}` writes a model that calls it"
        )
        raise InputError("unknown-model", name=reference, reason=reason)
    gallery_entry = entry(reference)
    if gallery_entry is not None:
        return ModelReference(gallery_entry.name, gallery_entry.model, gallery_entry)
    names = [listed.name for listed in entries()]
    near = get_close_matches(reference, names, n=1)
    reason = f"did you mean `{near[0]}`?" if near else f"the gallery has {', '.join(names)}"
    raise InputError("unknown-model", name=reference, reason=reason)


def names_in(reference: str) -> list[str]:
    """Return the references of the models of a file: the file's own name if it has a single model, or names one."""
    if not reference.endswith(".py"):
        return [reference]
    module, _ = run_file(Path(reference).resolve())
    local = _models_of(module)[0]
    return [reference] if len(local) < 2 else [f"{reference}:{name}" for name in local]


def _models_of(module: ModuleType) -> tuple[list[str], list[str]]:
    """Return the names of the models that a module defines, and of all its models: it may import models."""
    models = {key: value for key, value in vars(module).items() if isinstance(value, Model)}
    local = [key for key, value in models.items() if value.function.__module__ == module.__name__]
    return local, list(models)


def _in_file(reference: str, place: Path, name: str) -> ModelReference:
    if not place.is_file():
        raise InputError("unknown-model", name=reference, reason=f"there is no file {place.absolute()}")
    module, digest = run_file(place.resolve())
    space = vars(module)
    local, models = _models_of(module)
    for keys in (local, models):
        if not name and len(keys) == 1:
            name = keys[0]
    stem = re.sub(r"\W", "_", place.stem)
    if not name and stem in local:
        # Of several models the one that is named like its file is the main one; the others are its parts.
        name = stem
    function = space.get(name)
    if isinstance(function, FunctionType):
        function = Model(function)
    if not isinstance(function, Model):
        reason = f"{place} defines {', '.join(models) or 'no function marked with `@model`'}"
        if not name and len(models) > 1:
            reason = f"{reason}: name one of them, as in {place.name}:{(local or models)[0]}"
        raise InputError("unknown-model", name=reference, reason=reason)
    return ModelReference(f"{place.resolve()}:{name}", function, file_hash=digest)
