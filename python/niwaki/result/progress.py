"""How far a search is: what the user's `progress` function receives, and the function that the engine calls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Progress:
    """How far a search is; given to `progress` now and then.

    Attributes
    ----------
    run, runs : int
        Which of how many runs, from 0.
    done : int
        Barriers of a population, then rounds of `improve`; runs of the other methods.
    ended : int
        Particles that have ended.
    best : float
        Best log score of the population so far, nats.
    """

    run: int
    runs: int
    done: int
    ended: int
    best: float


Watch = Callable[[Progress], None]
#: What the engine calls: done, ended, best log score.
EngineWatch = Callable[[int, int, float], None]


def watcher(progress: Watch | None, number: int = 0, runs: int = 1) -> EngineWatch:
    """The function that the engine calls, around the user's `progress`."""

    def watch(done: int, ended: int, best: float) -> None:
        if progress is not None:
            progress(Progress(number, runs, done, ended, best))

    return watch
