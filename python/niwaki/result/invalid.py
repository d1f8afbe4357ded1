"""Invalid runs of a search, by place: their number, and an example of each place."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import PurePath


@dataclass(frozen=True)
class Invalid:
    """Invalid runs at one place.

    A run is invalid if a call has no result for its arguments: a distribution whose parameters are out of range, an
    impossible shape, a host function that raises an exception. The run has probability zero, and counts at the first
    such call.

    Attributes
    ----------
    name : str
        The name of the distribution, shape or host function.
    file : str
        The source file of the call.
    line : int
        The line of the call.
    runs : int
        The number of runs, proposals and points of trajectories that were invalid there.
    call : str
        The shortest of the calls, with its arguments.
    reason : str
        The reason why that call has no result; empty for a result that was stored in a batch.
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
    """Merge the invalid runs of several searches, by place, in the order of files and lines."""
    by_place: dict[tuple[str, int, str], Invalid] = {}
    for entry in chain.from_iterable(several):
        place = (entry.file, entry.line, entry.name)
        before = by_place.get(place, replace(entry, runs=0))
        # The engine takes the same example, which does not depend on the order.
        shortest = min(entry, before, key=lambda example: (len(example.call), example.call, example.reason))
        by_place[place] = replace(shortest, runs=entry.runs + before.runs)
    return tuple(by_place[place] for place in sorted(by_place))
