"""How far a search is: what the user's `progress` function receives, and the function that the engine calls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from niwaki import _engine
from niwaki.result.sample import Sample
from niwaki.result.search_like import SearchLike


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
    sample : Sample or None
        The best so far of `improve` after its first population; `sample.scene` is its scene.
    """

    run: int
    runs: int
    done: int
    ended: int
    best: float
    sample: Sample | None = field(default=None, compare=False)


Watch = Callable[[Progress], None]
#: What the engine calls: done, ended, best log score, best run.
EngineWatch = Callable[[int, int, float, _engine.Run | None], None]


def watcher(progress: Watch | None, search: SearchLike, number: int = 0, runs: int = 1) -> EngineWatch:
    """The function that the engine calls, around the user's `progress`."""

    def watch(done: int, ended: int, best: float, run: _engine.Run | None) -> None:
        if progress is not None:
            sample = None if run is None else Sample(run, search, (search.seed + number) % 2**64)
            progress(Progress(number, runs, done, ended, best, sample))

    return watch
