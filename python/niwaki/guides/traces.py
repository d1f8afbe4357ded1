"""Traces for training: many searches side by side, each for its best run."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from concurrent.futures import ThreadPoolExecutor
from threading import Event
from typing import Any

from niwaki.errors import InputError, ModelFault
from niwaki.result import Sample
from niwaki.search import Search


class _Stopped(Exception):
    """An exception that ends a search from its `progress`."""


def best_of(
    searches: Sequence[Search], workers: int, faults: list[ModelFault] | None = None
) -> Generator[Sample | None]:
    """Yield the best sample of each search, in order; None if all particles became impossible, or a run had a fault.

    The searches run on `workers` threads. Close the iterator (`contextlib.closing`) to end searches that still run, and
    to drop those that wait. Faults are added to `faults`.
    """
    stop = Event()

    def watch(_: Any) -> None:
        if stop.is_set():
            raise _Stopped

    def best_sample(search: Search) -> Sample | None:
        try:
            result = search.run(threads=1, progress=watch)
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
        return max(result, key=lambda sample: sample.log_score + sample.log_prior)

    pool = ThreadPoolExecutor(workers)
    try:
        yield from pool.map(best_sample, searches)
    finally:
        stop.set()
        pool.shutdown(wait=True, cancel_futures=True)
