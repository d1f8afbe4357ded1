"""Executors for chunks: any `concurrent.futures.Executor`, or a pool of spawned processes of this module.

The module's own pool is replaced when it breaks. An executor of the caller stays open.
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

from niwaki.batches.worker import Chunk, ChunkResult, work
from niwaki.errors import InputError
from niwaki.errors.processes import end_group, lead
from niwaki.errors.settings import bad, count, real

#: Most processes of the module's own pool.
MOST = 512

#: Default seconds of a chunk.
TARGET = 2.0

#: Priority of a function at the exit of a process, above all priorities of the standard library.
FIRST = 1000

#: Chunks under way for each worker, so that the next chunk is ready when a worker is done.
AHEAD = 2


def cores() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def local(processes: int) -> ProcessPoolExecutor:
    """Return a pool of spawned processes, which end with this process however it ends."""
    context = multiprocessing.get_context("spawn")
    return ProcessPoolExecutor(processes, mp_context=context, initializer=_begin)


def _begin() -> None:
    """Prepare a worker process: ignore Ctrl-C, and end with the parent process.

    Processes that host functions start end with the worker.
    """
    lead()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # This runs before the worker would wait for its child processes.
    Finalize(None, _end, exitpriority=FIRST)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent.join,), daemon=True).start()


def _follow(wait_for_parent: Callable[[], None]) -> None:
    wait_for_parent()
    end_group(os.getpid())
    os._exit(1)


def _end() -> None:
    with suppress(AttributeError, OSError, ValueError):
        sys.stdout.flush()
    end_group(os.getpid())


class Workers:
    """An executor with its number of workers.

    Parameters
    ----------
    executor
        An executor. Default: a pool of processes of this machine.
    processes
        Number of workers. Default: the processors of the machine.
    seconds
        Seconds of searches, about, that a worker gets at once.
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
        self._executor, self._pool = executor, None if executor else self._start_pool()
        self._answered = False

    def _start_pool(self) -> ProcessPoolExecutor:
        """Start a pool of processes with a first task, which shows whether workers start."""
        pool = local(self.count)
        self._hello = pool.submit(os.getpid)
        return pool

    @property
    def depth(self) -> int:
        """Most chunks under way."""
        return self.count * AHEAD

    def submit(self, chunk: Chunk) -> Future[ChunkResult]:
        """Give a chunk to a worker."""
        executor = self._executor or self._pool
        assert executor is not None
        return executor.submit(work, chunk)

    def renew(self, reason: BaseException) -> None:
        """Replace the pool after it broke.

        Raises
        ------
        InputError
            The executor belongs to the caller, or no worker of the pool has ever answered.
        """
        if self._pool is None:
            raise InputError("executor-broken", reason=str(reason) or type(reason).__name__) from reason
        leaders = self._leaders()
        self._pool.shutdown(wait=True, cancel_futures=True)
        for leader in leaders:
            end_group(leader)
        self._answered = self._answered or not (self._hello.cancelled() or self._hello.exception())
        if not self._answered:
            # New workers would end in the same way, before any search.
            raise InputError("workers-not-started") from reason
        self._pool = self._start_pool()

    def end_orphans(self) -> None:
        """End the children of lost workers; a forked child keeps the pipe open that reports the loss."""
        for leader, process in self._leaders().items():
            if not process.is_alive():
                end_group(leader)

    def close(self, at_once: bool) -> None:
        """End the pool; with `at_once` also its running chunks."""
        if self._pool is None:
            return
        processes = self._leaders() if at_once else {}
        self._pool.shutdown(wait=False, cancel_futures=True)
        for leader, process in processes.items():
            end_group(leader)
            # A process that has just started leads no group yet.
            process.kill()
        for process in processes.values():
            process.join()

    def _leaders(self) -> dict[int, BaseProcess]:
        """Return the processes of the pool, by their numbers."""
        return dict(getattr(self._pool, "_processes", None) or {})
