"""Where chunks are worked on: any `concurrent.futures.Executor`; a pool of spawned processes when none is given.

Our own pool is made anew when it breaks. An executor that was given belongs to whoever made it, and stays open.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import suppress
from multiprocessing.process import BaseProcess
from multiprocessing.util import Finalize

from niwaki.batches.working import Chunk, Done, work
from niwaki.errors import InputError
from niwaki.errors.processes import end_group, lead
from niwaki.errors.settings import bad, count, real

#: The most processes of a pool of ours.
MOST = 512

#: Seconds of a chunk.
TARGET = 2.0

#: A priority at the exit of a process, above those of the standard library.
FIRST = 1000

#: Chunks under way for each worker: while one is worked on, the next one is there.
AHEAD = 2


def cores() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def local(processes: int) -> ProcessPoolExecutor:
    """A pool of spawned processes, which end with this one, whatever ends it."""
    context = multiprocessing.get_context("spawn")
    return ProcessPoolExecutor(processes, mp_context=context, initializer=_begin)


def _begin() -> None:
    """In a worker: Ctrl-C is for the process that collects, and without that one there is nothing to do.

    What host functions have started ends with the worker.
    """
    lead()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # Before it would wait for processes of its own.
    Finalize(None, _end, exitpriority=FIRST)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent.join,), daemon=True).start()


def _follow(ended: Callable[[], None]) -> None:
    ended()
    end_group(os.getpid())
    os._exit(1)


def _end() -> None:
    with suppress(AttributeError, OSError, ValueError):
        sys.stdout.flush()
    end_group(os.getpid())


class Workers:
    """An executor, and what is known about it.

    Parameters
    ----------
    executor
        An executor; a pool of our own when left out.
    processes
        How many workers it has; the processors of the machine when left out.
    seconds
        About so many seconds of searches are given to a worker at once.
    """

    def __init__(
        self, executor: Executor | None = None, processes: int | None = None, seconds: float = TARGET
    ) -> None:
        if executor is not None and not isinstance(executor, Executor):
            raise bad(
                "executor",
                executor,
                "an executor of `concurrent.futures`",
                "None, for processes of this machine",
            )
        self.seconds = real("chunk", seconds, 0, 3600, "[]", str(TARGET))
        known = getattr(executor, "_max_workers", None)
        self.count = count("processes", processes or known or cores(), most=1 << 20 if executor else MOST)
        self._given, self._own = executor, None if executor else self._started()
        self._answered = False

    def _started(self) -> ProcessPoolExecutor:
        """A pool of our own, which is first asked whether it is there."""
        own = local(self.count)
        self._hello = own.submit(os.getpid)
        return own

    @property
    def depth(self) -> int:
        """How many chunks may be under way."""
        return self.count * AHEAD

    def submit(self, chunk: Chunk) -> Future[Done]:
        """Give a chunk to a worker."""
        executor = self._given or self._own
        assert executor is not None
        return executor.submit(work, chunk)

    def renew(self, reason: BaseException) -> None:
        """Begin again after the pool broke.

        Raises
        ------
        InputError
            The executor is not ours, or no worker of ours has ever answered.
        """
        if self._own is None:
            raise InputError("executor-broken", reason=str(reason) or type(reason).__name__) from reason
        leaders = self._leaders()
        self._own.shutdown(wait=True, cancel_futures=True)
        for leader in leaders:
            end_group(leader)
        self._answered = self._answered or not (self._hello.cancelled() or self._hello.exception())
        if not self._answered:
            # Others would end as they did, before any search.
            raise InputError("workers-not-started") from reason
        self._own = self._started()

    def end_orphans(self) -> None:
        """End what lost workers of our own pool have started: a child of a fork keeps open what tells of the loss."""
        for leader, process in self._leaders().items():
            if not process.is_alive():
                end_group(leader)

    def close(self, at_once: bool) -> None:
        """End our own pool; `at_once` also what is under way."""
        if self._own is None:
            return
        processes = self._leaders() if at_once else {}
        self._own.shutdown(wait=False, cancel_futures=True)
        for leader, process in processes.items():
            end_group(leader)
            # One that has only just been started leads no group yet.
            process.kill()
        for process in processes.values():
            process.join()

    def _leaders(self) -> dict[int, BaseProcess]:
        """The processes of our own pool, by their numbers."""
        return dict(getattr(self._own, "_processes", None) or {})
