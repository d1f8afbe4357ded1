"""What a session is about, apart from how it is shown: the part of the state that undo takes back.

A document is the fold of its changes: each step of the journal replaces some of its fields. So undo moves a head, and
two documents are the same if their hashes are.
"""

from __future__ import annotations

import hashlib
from typing import Any

import msgspec
from msgspec import Struct

from niwaki.studio.messages import Ask, HeldPart, Key, Outcome, Settings


class Document(Struct, kw_only=True):
    """A session's model, what is asked of it, its results, and what the user has marked.

    Attributes
    ----------
    model
        A reference.
    arguments
        Of the model, by name.
    results
        The gallery, in its order.
    picked
        The result that is shown and worked on.
    held
        Held parts, with the values that hold them.
    stars
        Marked results; they stay in the gallery when others come.
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
        """The document with other values of some fields, given as plain data."""
        return msgspec.convert({**msgspec.to_builtins(self), **changes}, Document)

    @property
    def hash(self) -> str:
        """SHA-256 of all of it, in hexadecimal."""
        return hashlib.sha256(msgspec.json.encode(self, order="deterministic")).hexdigest()

    def starred(self) -> list[Outcome]:
        """The marked results, in the order of the gallery."""
        return [one for one in self.results if one.key in self.stars]
