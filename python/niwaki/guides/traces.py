"""Many searches side by side, each for its best run."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from concurrent.futures import ThreadPoolExecutor
from threading import Event
from typing import Any

from niwaki.errors import InputError, ModelFault
from niwaki.result import Sample
from niwaki.search import Search


class _Stopped(Exception):
    """Ends a search from within its `progress`."""


def best_of(
    searches: Sequence[Search], workers: int, faults: list[ModelFault] | None = None
) -> Generator[Sample | None]:
    """The best sample of each search, in order; None where every particle became impossible, or a run had a fault.

    The searches run on so many threads. Close the iterator (`contextlib.closing`) to end those that still run and to
    drop those that wait. Faults are added to `faults`.
    """
    stop = Event()

    def watch(_: Any) -> None:
        if stop.is_set():
            raise _Stopped

    def one(search: Search) -> Sample | None:
        try:
            found = search.run(threads=1, progress=watch)
        except _Stopped:
            return None
        except ModelFault as fault:
            if faults is not None:
                faults.append(fault)
            return None
        except InputError as error:
            if error.code != "everything-impossible":
                raise
            return None
        return max(found, key=lambda sample: sample.log_score + sample.log_prior)

    pool = ThreadPoolExecutor(workers)
    try:
        yield from pool.map(one, searches)
    finally:
        stop.set()
        pool.shutdown(wait=True, cancel_futures=True)
