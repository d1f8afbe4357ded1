"""The execution of a batch: chunks go to workers, results go to the store, and chunks of lost workers run again.

When a pool breaks, the cause may be any of the chunks under way. They run again without a charge; a chunk that was
under way twice is split into its searches, which run alone. A search that breaks a pool alone, or meets trouble, is
charged with an attempt, and is abandoned after three.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Generator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from dataclasses import dataclass

from niwaki.batches.plan import SUSPECT, Job, Plan
from niwaki.batches.pools import Workers
from niwaki.batches.store import StoreWriter
from niwaki.batches.worker import Chunk, ChunkResult, line
from niwaki.errors import InputError

#: Longest seconds of a `wait`, for systems on which Ctrl-C does not interrupt it.
LOOK = 1.0

#: Seconds in which a broken pool reports the errors of all its chunks.
GRACE = 30.0


@dataclass(frozen=True)
class BatchProgress:
    """The progress of a batch.

    Attributes
    ----------
    done, total : int
        Number of searches that have a result, and of all searches.
    earlier : int
        Number of results from before this call.
    faults, lost : int
        Number of searches of this call that failed, and that were abandoned because they lost their workers.
    seconds, cpu_seconds : float
        Wall-clock seconds of this call, and processor seconds of all workers for its searches.
    """

    done: int
    total: int
    earlier: int
    faults: int
    lost: int
    seconds: float
    cpu_seconds: float

    @property
    def rate(self) -> float:
        """Searches of this call in a second."""
        return (self.done - self.earlier) / self.seconds if self.seconds > 0.0 else 0.0

    @property
    def seconds_left(self) -> float | None:
        """Seconds for the rest at this rate; None before the first result."""
        return (self.total - self.done - self.lost) / self.rate if self.rate > 0.0 else None


Watch = Callable[[BatchProgress], None]


class Execution:
    """An execution of a plan by workers.

    Parameters
    ----------
    plan
        The searches to run.
    writer
        The writer of results.
    workers
        The workers.
    watch
        A function that gets a `BatchProgress` whenever results have come.
    """

    def __init__(self, plan: Plan, writer: StoreWriter, workers: Workers, watch: Watch | None = None) -> None:
        self._plan, self._writer, self._workers, self._watch = plan, writer, workers, watch
        self._in_flight: dict[Future[ChunkResult], Chunk] = {}
        self._alone = False
        self._earlier = plan.total - plan.left
        self._start = time.monotonic()
        self._faults, self._cpu = 0, 0.0

    @property
    def progress(self) -> BatchProgress:
        """The progress so far."""
        done, lost = self._plan.total - self._plan.left - len(self._plan.lost), len(self._plan.lost)
        spent = time.monotonic() - self._start
        return BatchProgress(done, self._plan.total, self._earlier, self._faults, lost, spent, self._cpu)

    def steps(self) -> Generator[None, None, None]:
        """Run the plan; each step has brought results or trouble.

        Raises
        ------
        InputError
            A worker has another engine, or the caller's executor broke.
        FileError
            The folder cannot be written to, or the disk is full.
        """
        ended = False
        try:
            while self._send() or self._in_flight:
                finished, _ = wait(self._in_flight, timeout=LOOK, return_when=FIRST_COMPLETED)
                if not finished:
                    self._workers.end_orphans()
                broken = self._collect(finished)
                if broken is not None:
                    rest, _ = wait(self._in_flight, timeout=GRACE)
                    self._collect(rest)
                    for chunk in self._in_flight.values():
                        self._suspect(chunk)
                    self._in_flight.clear()
                    self._workers.renew(broken)
                if finished:
                    if self._watch is not None:
                        self._watch(self.progress)
                    yield
            ended = True
        finally:
            for future in self._in_flight:
                future.cancel()
            self._workers.close(at_once=not ended)

    def _send(self) -> bool:
        """Give chunks to workers that have too few; return whether a chunk was sent."""
        sent = False
        while len(self._in_flight) < self._workers.depth and not (self._alone and self._in_flight):
            chunk = self._plan.take(self._workers.count, not self._in_flight)
            if chunk is None:
                break
            self._alone = chunk.suspected >= SUSPECT
            try:
                self._in_flight[self._workers.submit(chunk)] = chunk
            except BrokenExecutor as error:
                future: Future[ChunkResult] = Future()
                future.set_exception(error)
                self._in_flight[future] = chunk
                break
            sent = True
        return sent

    def _collect(self, finished: set[Future[ChunkResult]]) -> BaseException | None:
        """Store finished chunks; return the error of a broken pool, or None."""
        broken: BaseException | None = None
        for future in finished:
            chunk = self._in_flight.pop(future)
            try:
                done = future.result()
            except (BrokenExecutor, CancelledError) as error:
                broken = error
                self._suspect(chunk)
            except Exception as error:
                # An error of Ray or Dask, whose pools do not break with one worker.
                reason = str(error).partition("\n")[0]
                self._plan.fail(chunk, f"{type(error).__name__}: {reason}")
            else:
                self._take(chunk, done)
        return broken

    def _suspect(self, chunk: Chunk) -> None:
        if self._alone:
            self._plan.charge(chunk.jobs[0], "its worker was lost", chunk.suspected)
        else:
            self._plan.suspect(chunk)

    def _take(self, chunk: Chunk, done: ChunkResult) -> None:
        """Store the result of a chunk."""
        if done.refused:
            raise InputError("worker-differs", reason=done.refused)
        jobs = list(chunk.jobs[: len(done.bodies)])
        keys = [self._plan.spec.key(*job) for job in jobs]
        lines = [
            line(key, note, self._plan.attempt(job))
            for key, note, job in zip(keys, done.notes, jobs, strict=True)
        ]
        self._writer.add(zip(keys, done.bodies, strict=True), lines)
        self._plan.finish(jobs, done.seconds)
        self._faults += sum("error" in note for note in done.notes)
        self._cpu += done.cpu_seconds
        if done.trouble:
            job = chunk.jobs[len(jobs)]
            note = {"trouble": done.trouble, "trace": done.trace}
            self._writer.add((), [line(self._plan.spec.key(*job), note, self._plan.attempt(job))])
            self._plan.charge(job, done.trouble)
            self._plan.requeue(list(chunk.jobs[len(jobs) + 1 :]))


def lost(jobs: dict[Job, str], total: int) -> InputError:
    """Return the error about abandoned searches."""
    (case, seed), reason = next(iter(jobs.items()))
    return InputError("searches-lost", count=len(jobs), total=total, case=case, seed=seed, reason=reason)
