"""Invalid runs of a search: how many there were, where, and an example of each place."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import PurePath


@dataclass(frozen=True)
class Invalid:
    """Invalid runs at one place.

    A run is invalid where a call has no result for its arguments: a distribution whose parameters are out of range, a
    shape that cannot be, a host function that raises an exception. It has probability zero, and counts at the first
    such call.

    Attributes
    ----------
    name : str
        What is called: a distribution, a shape, a host function.
    file : str
        The source file of the call.
    line : int
        Its line.
    runs : int
        How many runs, proposals and points of trajectories were invalid there.
    call : str
        The call of one of them, with its arguments: the shortest.
    reason : str
        Why that call has no result; empty where the result was stored in a batch.
    """

    name: str
    file: str
    line: int
    runs: int
    call: str
    reason: str

    def __str__(self) -> str:
        runs = f"{self.runs} run{'' if self.runs == 1 else 's'}"
        reason = f": {self.reason}" if self.reason else ""
        return f"`{self.name}` at {PurePath(self.file).name}:{self.line}, {runs}, for instance {self.call}{reason}"


def merged(*several: Iterable[Invalid]) -> tuple[Invalid, ...]:
    """Those of several searches together, by place, in the order of files and lines."""
    found: dict[tuple[str, int, str], Invalid] = {}
    for one in (one for some in several for one in some):
        place = (one.file, one.line, one.name)
        other = found.get(place, replace(one, runs=0))
        # As in the engine: the example does not depend on the order.
        shortest = min(one, other, key=lambda own: (len(own.call), own.call, own.reason))
        found[place] = replace(shortest, runs=one.runs + other.runs)
    return tuple(found[place] for place in sorted(found))
