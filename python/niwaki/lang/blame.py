"""Parts of scenes that broke a constraint, in words; the engine counts them (`crates/run/src/blame.rs`)."""

from __future__ import annotations

from typing import Any, NamedTuple

from niwaki import _engine
from niwaki.errors.kinds import place
from niwaki.errors.source import Span
from niwaki.lang.labels import SEPARATOR, Labels
from niwaki.lang.nouns import words


class Emitted(NamedTuple):
    """A place in the source that emits parts.

    Attributes
    ----------
    address : str
        The address of such a part.
    function : str
        The function that emits it.
    path : str
        The path of the source file.
    span : tuple of int
        First line, first column, last line, column after the last character.
    """

    address: str
    function: str
    path: str
    span: tuple[int, int, int, int]

    def name(self, labels: Labels) -> str:
        """Return the part's label; after its function if the model gives the part no name: `tower › box`."""
        kind = labels.kind(self.address)
        # The text after a slash is a loop of the function.
        function = self.function.partition("/")[0].rpartition(".")[2]
        is_named = not self.address.rpartition("/")[2].startswith("emit")
        return kind if is_named else f"{words(function)}{SEPARATOR}{kind}"

    @property
    def place(self) -> Span:
        """The place in the source."""
        return place(self.path, *self.span)

    def text(self, labels: Labels) -> str:
        """Return the part's name with its line."""
        return f'"{self.name(labels)}" (line {self.span[0]})'


class Blame(NamedTuple):
    """A part that broke a constraint, and the number of runs in which it did.

    Attributes
    ----------
    constraint : str
        The constraint's name.
    part : Emitted
        The part that broke it.
    other : Emitted or None
        The other part, if two parts together broke the constraint.
    runs : int
        The number of runs.
    """

    constraint: str
    part: Emitted
    other: Emitted | None
    runs: int

    @classmethod
    def of(cls, data: Any) -> Blame:
        """Make a `Blame` from the data of the engine or of a file."""
        constraint, part, other, runs = data
        return cls(constraint, _emitted(part), None if other is None else _emitted(other), runs)

    def does(self, labels: Labels) -> str:
        """Return the part's effect in words: `runs into "road" (line 21)`."""
        if self.other is None:
            part, _ = _engine.SKETCHES.get(self.constraint) or (f"breaks {self.constraint}", "")
            return part
        if self.other[2:] == self.part[2:]:
            return "runs into another part of this line"
        return f"runs into {self.other.text(labels)}"

    def text(self, labels: Labels) -> str:
        """Return the part and its effect in words."""
        return f"{self.part.text(labels)} {self.does(labels)}"

    def __str__(self) -> str:
        return self.text(Labels())


def _emitted(data: Any) -> Emitted:
    address, function, path, span = data
    return Emitted(address, function, path, tuple(span))


def marked(blame: list[Blame], looked_at: int, labels: Labels) -> list[tuple[Span, str]]:
    """Return the places of the parts that broke a constraint most often in `looked_at` runs, with labels."""
    if not blame:
        return []
    first = blame[0]
    places = [
        (first.part.place, f'"{first.part.name(labels)}" {first.does(labels)} in {first.runs} of {looked_at}')
    ]
    if first.other is not None and first.other.place != first.part.place:
        places.append((first.other.place, f'"{first.other.name(labels)}"'))
    return places
