"""A batch under way: chunks go to workers, results go to the store, and what a lost worker had is done again.

When a pool breaks, nobody knows which of the chunks under way did it. They are done again without blame; one that was
there twice is taken apart and done alone. Only what breaks a pool alone, or brings trouble by itself, is charged with
an attempt, and is given up after three.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Generator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from dataclasses import dataclass

from niwaki.batches.plan import SUSPECT, Item, Plan
from niwaki.batches.pools import Workers
from niwaki.batches.store import Own
from niwaki.batches.working import Chunk, Done, line
from niwaki.errors import InputError

#: Seconds after which `wait` looks for Ctrl-C, where the system does not interrupt it.
LOOK = 1.0

#: Seconds in which a broken pool says so of all its chunks.
GRACE = 30.0


@dataclass(frozen=True)
class Standing:
    """How far a batch is.

    Attributes
    ----------
    done, total : int
        Searches that have a result, of how many.
    begun : int
        How many of them were there before.
    faults, lost : int
        Searches of this run that failed; that were given up, because they lost their workers.
    seconds, cpu_seconds : float
        Since this run began; and of the processors of all workers, for the searches of this run.
    """

    done: int
    total: int
    begun: int
    faults: int
    lost: int
    seconds: float
    cpu_seconds: float

    @property
    def rate(self) -> float:
        """Searches in a second."""
        return (self.done - self.begun) / self.seconds if self.seconds > 0.0 else 0.0

    @property
    def seconds_left(self) -> float | None:
        """Seconds that the rest takes at this rate; None while there is none."""
        return (self.total - self.done - self.lost) / self.rate if self.rate > 0.0 else None


Watch = Callable[[Standing], None]


class Running:
    """A run of a batch.

    Parameters
    ----------
    plan
        What is to be done.
    own
        Where results are written.
    workers
        Who does it.
    watch
        Called with a `Standing` whenever results came.
    """

    def __init__(self, plan: Plan, own: Own, workers: Workers, watch: Watch | None = None) -> None:
        self._plan, self._own, self._workers, self._watch = plan, own, workers, watch
        self._flying: dict[Future[Done], Chunk] = {}
        self._alone = False
        self._begun = plan.total - plan.left
        self._start = time.monotonic()
        self._faults, self._cpu = 0, 0.0

    @property
    def standing(self) -> Standing:
        """How far it is."""
        done, lost = self._plan.total - self._plan.left - len(self._plan.lost), len(self._plan.lost)
        spent = time.monotonic() - self._start
        return Standing(done, self._plan.total, self._begun, self._faults, lost, spent, self._cpu)

    def steps(self) -> Generator[None, None, None]:
        """Go on; each step has brought results or trouble.

        Raises
        ------
        InputError
            A worker has another engine, or an executor that is not ours broke.
        FileError
            The folder cannot be written to, or the disk is full.
        """
        ended = False
        try:
            while self._send() or self._flying:
                finished, _ = wait(self._flying, timeout=LOOK, return_when=FIRST_COMPLETED)
                if not finished:
                    self._workers.end_orphans()
                broken = self._collect(finished)
                if broken is not None:
                    rest, _ = wait(self._flying, timeout=GRACE)
                    self._collect(rest)
                    for chunk in self._flying.values():
                        self._suspect(chunk)
                    self._flying.clear()
                    self._workers.renew(broken)
                if finished:
                    if self._watch is not None:
                        self._watch(self.standing)
                    yield
            ended = True
        finally:
            for future in self._flying:
                future.cancel()
            self._workers.close(at_once=not ended)

    def _send(self) -> bool:
        """Give chunks to workers that have too few; whether there was one."""
        sent = False
        while len(self._flying) < self._workers.depth and not (self._alone and self._flying):
            chunk = self._plan.take(self._workers.count, not self._flying)
            if chunk is None:
                break
            self._alone = chunk.suspected >= SUSPECT
            try:
                self._flying[self._workers.submit(chunk)] = chunk
            except BrokenExecutor as error:
                future: Future[Done] = Future()
                future.set_exception(error)
                self._flying[future] = chunk
                break
            sent = True
        return sent

    def _collect(self, finished: set[Future[Done]]) -> BaseException | None:
        """Take what is finished; the error of a broken pool."""
        broken: BaseException | None = None
        for future in finished:
            chunk = self._flying.pop(future)
            try:
                done = future.result()
            except (BrokenExecutor, CancelledError) as error:
                broken = error
                self._suspect(chunk)
            except Exception as error:
                # The executor's own error: of Ray or Dask, whose pools do not break with one worker.
                reason = str(error).partition("\n")[0]
                self._plan.failed(chunk, f"{type(error).__name__}: {reason}")
            else:
                self._take(chunk, done)
        return broken

    def _suspect(self, chunk: Chunk) -> None:
        if self._alone:
            self._plan.charge(chunk.items[0], "its worker was lost", chunk.suspected)
        else:
            self._plan.suspect(chunk)

    def _take(self, chunk: Chunk, done: Done) -> None:
        """Store what a worker did."""
        if done.refused:
            raise InputError("worker-differs", reason=done.refused)
        items = list(chunk.items[: len(done.bodies)])
        keys = [self._plan.spec.key(*item) for item in items]
        lines = [
            line(key, note, self._plan.attempt(item))
            for key, note, item in zip(keys, done.notes, items, strict=True)
        ]
        self._own.add(zip(keys, done.bodies, strict=True), lines)
        self._plan.done(items, done.seconds)
        self._faults += sum("error" in note for note in done.notes)
        self._cpu += done.cpu_seconds
        if done.trouble:
            item = chunk.items[len(items)]
            said = {"trouble": done.trouble, "trace": done.trace}
            self._own.add((), [line(self._plan.spec.key(*item), said, self._plan.attempt(item))])
            self._plan.charge(item, done.trouble)
            self._plan.again(list(chunk.items[len(items) + 1 :]))


def lost(items: dict[Item, str], total: int) -> InputError:
    """The error about searches that were given up."""
    (case, seed), reason = next(iter(items.items()))
    return InputError("searches-lost", count=len(items), total=total, case=case, seed=seed, reason=reason)
