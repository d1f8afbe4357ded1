"""Parts of scenes that broke a constraint, in words; the engine counts them (`crates/run/src/blame.rs`)."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from niwaki import _engine
from niwaki.errors.kinds import place
from niwaki.errors.source import Span


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

    @property
    def name(self) -> str:
        """The part's name, or the function and `emit` if the model gives no name: `tower/emit`."""
        last = re.sub(r"\[[^]]*\]$", "", self.address.rpartition("/")[2])
        # The text after a slash is a loop of the function.
        function = self.function.partition("/")[0].rpartition(".")[2]
        return f"{function}/emit" if last == "emit" else last

    @property
    def place(self) -> Span:
        """The place in the source."""
        return place(self.path, *self.span)

    def __str__(self) -> str:
        return f"`{self.name}` (line {self.span[0]})"


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

    @property
    def does(self) -> str:
        """The part's effect, in words: `runs into `road` (line 21)`."""
        if self.other is None:
            part, _ = _engine.SKETCHES.get(self.constraint) or (f"breaks {self.constraint}", "")
            return part
        if self.other[2:] == self.part[2:]:
            return "runs into another part of this line"
        return f"runs into {self.other}"

    def __str__(self) -> str:
        return f"{self.part} {self.does}"


def _emitted(data: Any) -> Emitted:
    address, function, path, span = data
    return Emitted(address, function, path, tuple(span))


def marked(blame: list[Blame], looked_at: int) -> list[tuple[Span, str]]:
    """Return the places of the parts that broke a constraint most often in `looked_at` runs, with labels."""
    if not blame:
        return []
    first = blame[0]
    places = [(first.part.place, f"`{first.part.name}` {first.does} in {first.runs} of {looked_at}")]
    if first.other is not None and first.other.place != first.part.place:
        places.append((first.other.place, f"`{first.other.name}`"))
    return places
