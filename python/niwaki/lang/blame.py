"""Which parts of scenes broke a constraint, in words; the engine counts them (`crates/run/src/blame.rs`)."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from niwaki import _engine
from niwaki.errors.kinds import place
from niwaki.errors.source import Span


class Emitted(NamedTuple):
    """Where a part is emitted.

    Attributes
    ----------
    address : str
        Of one such part.
    function : str
        That emits it.
    path : str
        Of the source file.
    span : tuple of int
        First line, first column, last line, column after the last character.
    """

    address: str
    function: str
    path: str
    span: tuple[int, int, int, int]

    @property
    def name(self) -> str:
        """The part's own name, or the function and `emit`, where the model gives none: `tower/emit`."""
        last = re.sub(r"\[[^]]*\]$", "", self.address.rpartition("/")[2])
        # What is after a slash is a loop in it.
        function = self.function.partition("/")[0].rpartition(".")[2]
        return f"{function}/emit" if last == "emit" else last

    @property
    def place(self) -> Span:
        """The place in the source."""
        return place(self.path, *self.span)

    def __str__(self) -> str:
        return f"`{self.name}` (line {self.span[0]})"


class Blame(NamedTuple):
    """Parts that broke a constraint, and in how many runs.

    Attributes
    ----------
    constraint : str
        Its name.
    part : Emitted
        The part that broke it.
    other : Emitted or None
        The part with which it did, where it did not alone.
    runs : int
        In how many runs.
    """

    constraint: str
    part: Emitted
    other: Emitted | None
    runs: int

    @classmethod
    def of(cls, data: Any) -> Blame:
        """Read what the engine gives, or a file."""
        constraint, part, other, runs = data
        return cls(constraint, _emitted(part), None if other is None else _emitted(other), runs)

    @property
    def does(self) -> str:
        """What the part does: `runs into `road` (line 21)`."""
        if self.other is None:
            part, _ = _engine.SKETCHES.get(self.constraint) or (f"breaks {self.constraint}", "")
            return part
        if self.other[2:] == self.part[2:]:
            return "runs into another one of this line"
        return f"runs into {self.other}"

    def __str__(self) -> str:
        return f"{self.part} {self.does}"


def _emitted(data: Any) -> Emitted:
    address, function, path, span = data
    return Emitted(address, function, path, tuple(span))


def marked(blame: list[Blame], looked_at: int) -> list[tuple[Span, str]]:
    """The places of the parts that most often broke a constraint, of `looked_at` runs, with labels."""
    if not blame:
        return []
    first = blame[0]
    found = [(first.part.place, f"`{first.part.name}` {first.does} in {first.runs} of {looked_at}")]
    if first.other is not None and first.other.place != first.part.place:
        found.append((first.other.place, f"`{first.other.name}`"))
    return found
