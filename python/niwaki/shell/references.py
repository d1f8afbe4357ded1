"""Models by reference: a name of the gallery, or `file.py:function`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from types import FunctionType
from typing import Any

from niwaki.errors import InputError
from niwaki.gallery import Entry, entries, entry
from niwaki.inputs.modules import run_file
from niwaki.lang.models import Model
from niwaki.targets import asks
from niwaki.targets.sketches import Ask


@dataclass(frozen=True)
class ModelReference:
    """A model, and the reference to load it again.

    Attributes
    ----------
    reference : str
        A gallery name, or `path:function` with the whole path.
    model : Model
        The model.
    entry : Entry or None
        Its place in the gallery.
    file_hash : str or None
        SHA-256 of the bytes of its file, which were run; None for the gallery's.
    """

    reference: str
    model: Model[..., Any]
    entry: Entry | None = None
    file_hash: str | None = None

    def asked(self, options: Mapping[str, Any]) -> list[Ask]:
        """What is asked by options (`niwaki.targets.asks`), or is usual where they match nothing."""
        if self.entry is None:
            return asks.sketches_of(options, name=self.reference)
        return asks.sketches_of(options, self.entry.asks, self.entry.window, self.reference)

    @property
    def style(self) -> str | None:
        """The style of its drawings; None for models in space."""
        return None if self.entry is None else self.entry.draws

    @property
    def follows(self) -> bool:
        """Whether the model starts where a drawing does: its parameters are x, y and ahead."""
        return set(self.model.core().parameters) >= {"x", "y", "ahead"}

    def start(self, asked: Iterable[Ask]) -> dict[str, Any]:
        """The arguments of a model that follows a drawing; none of another model."""
        return asks.start(asked) if self.follows else {}


def find(reference: str) -> ModelReference:
    """Find a model by its gallery name or `file.py:function`; the file is run."""
    place, colon, name = reference.rpartition(":")
    if reference.endswith(".py"):
        place, colon, name = reference, ":", ""
    if colon and place.endswith(".py"):
        return _in_file(reference, Path(place), name)
    known = entry(reference)
    if known is not None:
        return ModelReference(known.name, known.model, known)
    names = [one.name for one in entries()]
    near = get_close_matches(reference, names, n=1)
    reason = f"did you mean `{near[0]}`?" if near else f"the gallery has {', '.join(names)}"
    raise InputError("unknown-model", name=reference, reason=reason)


def _in_file(reference: str, place: Path, name: str) -> ModelReference:
    if not place.is_file():
        raise InputError("unknown-model", name=reference, reason=f"there is no file {place.absolute()}")
    module, digest = run_file(place.resolve())
    space = vars(module)
    models = {key: value for key, value in space.items() if isinstance(value, Model)}
    # Beside a model of the file, one that it imports from elsewhere is not the one that is meant.
    own = [key for key, value in models.items() if value.function.__module__ == module.__name__]
    for keys in (own, list(models)):
        if not name and len(keys) == 1:
            name = keys[0]
    found = space.get(name)
    if isinstance(found, FunctionType):
        found = Model(found)
    if not isinstance(found, Model):
        here = ", ".join(models) or "no function marked with `@model`"
        raise InputError("unknown-model", name=reference, reason=f"{place} defines {here}")
    return ModelReference(f"{place.resolve()}:{name}", found, file_hash=digest)
