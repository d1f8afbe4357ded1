"""Progress of a search: the argument of the user's `progress` function, and the callback of the engine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from niwaki import _engine
from niwaki.result.sample import Sample
from niwaki.result.search_like import SearchLike


@dataclass(frozen=True)
class Progress:
    """Progress of a search; the argument of `progress`, at intervals.

    Attributes
    ----------
    run, runs : int
        The number of the run, from 0, and of all runs.
    done : int
        The number of barriers of a population, then of rounds of `improve`; of runs for other methods.
    ended : int
        The number of particles that have ended.
    best : float
        Best log score of the population so far, nats.
    sample : Sample or None
        The best sample so far of `improve` after its first population; `sample.scene` is its scene.
    """

    run: int
    runs: int
    done: int
    ended: int
    best: float
    sample: Sample | None = field(default=None, compare=False)


Watch = Callable[[Progress], None]
#: Callback of the engine: done, ended, best log score, best run.
EngineWatch = Callable[[int, int, float, _engine.Run | None], None]


def watcher(progress: Watch | None, search: SearchLike, number: int = 0, runs: int = 1) -> EngineWatch:
    """Wrap the user's `progress` as the callback of the engine."""

    def watch(done: int, ended: int, best: float, run: _engine.Run | None) -> None:
        if progress is not None:
            sample = None if run is None else Sample(run, search, (search.seed + number) % 2**64)
            progress(Progress(number, runs, done, ended, best, sample))

    return watch
