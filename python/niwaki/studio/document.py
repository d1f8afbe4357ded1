"""The document of a session: the part of its state that undo restores.

Each step of the journal replaces some fields of the document, so undo only moves a head. Two documents are equal if
their hashes are equal.
"""

from __future__ import annotations

import hashlib
from typing import Any

import msgspec
from msgspec import Struct

from niwaki.studio.messages import Ask, HeldPart, Key, Outcome, Settings


class Document(Struct, kw_only=True):
    """The document of a session: the model, the goals, the results, and the user's marks.

    Attributes
    ----------
    model
        The reference of the model.
    arguments
        Arguments of the model, by name.
    results
        The gallery of every model, in its order.
    picked
        The active result.
    held
        Held parts, with the values of their choices.
    stars
        Starred results; a new search keeps them in the gallery.
    """

    model: str | None = None
    arguments: dict[str, Any] = {}
    ask: Ask = Ask()
    settings: Settings = Settings()
    results: list[Outcome] = []
    picked: Key | None = None
    held: list[HeldPart] = []
    stars: list[Key] = []

    def changed(self, changes: dict[str, Any]) -> Document:
        """Return the document with other values of some fields, given as plain data."""
        return msgspec.convert({**msgspec.to_builtins(self), **changes}, Document)

    @property
    def hash(self) -> str:
        """SHA-256 of the document, in hexadecimal."""
        return hashlib.sha256(msgspec.json.encode(self, order="deterministic")).hexdigest()

    def kept(self) -> list[Outcome]:
        """Return what a new search keeps: starred results, and the results of other models, in their order."""
        return [
            outcome for outcome in self.results if outcome.key in self.stars or outcome.model != self.model
        ]

    def first(self, model: str) -> Key | None:
        """Return the key of a model's first result."""
        return next((outcome.key for outcome in self.results if outcome.model == model), None)
