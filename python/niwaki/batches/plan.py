"""The missing searches of a batch, and their division into chunks.

A chunk that is too small costs more time than its searches. A chunk that is too large is lost with its worker, and
leaves other workers idle at the end. So a chunk takes about the requested seconds, by the measured time of earlier
searches, and less when few searches are left.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator
from dataclasses import replace

from niwaki.batches.spec import Spec
from niwaki.batches.store import Store
from niwaki.batches.worker import Chunk
from niwaki.errors.settings import bad, is_whole
from niwaki.inputs.modules import files

#: Seconds of the smallest chunk, at the end of a batch.
LEAST = 0.1

#: Most searches of a chunk, which are sent at once and lost together with a worker.
MOST = 5_000

#: The weight of the last chunk in the running mean of seconds.
FRESH = 0.3

#: Most attempts at a search whose worker is lost, or has trouble.
ATTEMPTS = 3

#: A chunk that was under way in this many breaks of a pool runs alone, to find out whether it is the cause.
SUSPECT = 2

#: A search of a batch: the number of its case, and its seed.
Job = tuple[int, int]


def shard_of(shard: str | tuple[int, int] | None) -> tuple[int, int]:
    """Return a part of a batch as two numbers: (3, 16) or "3/16" is the third part of sixteen.

    Raises
    ------
    InputError
        The value is not a part of a batch.
    """
    match = re.fullmatch(r"(\d{1,7})/(\d{1,7})", shard) if isinstance(shard, str) else None
    parts = (1, 1) if shard is None else tuple(map(int, match.groups())) if match else shard
    if not isinstance(parts, tuple) or len(parts) != 2 or not all(map(is_whole, parts)):
        raise bad("shard", shard, "a part and the number of parts", "3/16, the third part of sixteen")
    if not 1 <= parts[0] <= parts[1]:
        raise bad(
            "shard", shard, "a part from 1 to the number of parts", f"1/{max(parts[1], 1)}, the first part"
        )
    return parts


class Pace:
    """The measured seconds of a search of each case."""

    def __init__(self) -> None:
        self._mean: float | None = None
        self._of_case: dict[int, float] = {}

    def note(self, jobs: list[Job], seconds: float) -> None:
        """Note the seconds that a worker took for the jobs of a chunk."""
        each = seconds / len(jobs)
        for case in {case for case, _ in jobs}:
            self._of_case[case] = _mixed(self._of_case.get(case), each)
        self._mean = _mixed(self._mean, each)

    def of(self, case: int) -> float | None:
        """Return the seconds of a search of a case; None before the first measurement."""
        return self._of_case.get(case, self._mean)

    @property
    def mean(self) -> float:
        """The mean seconds of a search, over all cases."""
        return self._mean or 0.0


def _mixed(old: float | None, new: float) -> float:
    return new if old is None else (1.0 - FRESH) * old + FRESH * new


class Plan:
    """The searches of a batch that are still to run.

    Parameters
    ----------
    store
        The store, with the results so far.
    shard
        The part of the batch, such as (3, 16): every 16th search, from the third.
    target
        Seconds of a chunk.
    trust, folders
        See `Chunk`.
    """

    def __init__(
        self,
        store: Store,
        shard: tuple[int, int],
        target: float,
        trust: tuple[str, ...] = (),
        folders: tuple[str, ...] = (),
    ) -> None:
        self.spec: Spec = store.spec
        self.total = sum(1 for _ in part(self.spec, shard))
        self._store, self._shard, self._target = store, shard, target
        self._trust, self._folders = trust, folders
        self._fresh = self._missing()
        self._next = next(self._fresh, None)
        self._again: deque[Chunk] = deque()
        self._attempts: dict[Job, int] = {}
        self.pace = Pace()
        self.left = sum(1 for _ in self._missing())
        #: Abandoned searches, with the reason.
        self.lost: dict[Job, str] = {}

    def _missing(self) -> Iterator[Job]:
        return (job for job in part(self.spec, self._shard) if self.spec.key(*job) not in self._store)

    def attempt(self, job: Job) -> int:
        """Return the number of the attempt at a search that is under way, from 1."""
        return self._attempts.get(job, 0) + 1

    def take(self, workers: int, alone: bool) -> Chunk | None:
        """Return the next chunk for a worker; None if there is no work at present.

        Parameters
        ----------
        workers
            Number of workers that share the rest.
        alone
            Whether no other chunk is under way.
        """
        if self._again:
            if self._again[0].suspected < SUSPECT or alone:
                return self._again.popleft()
            return None
        seconds = min(self._target, max(LEAST, self.left * self.pace.mean / (4 * workers)))
        jobs, spent = list[Job](), 0.0
        while self._next is not None and len(jobs) < MOST:
            each = self.pace.of(self._next[0])
            if jobs and (each is None or spent + each > seconds):
                break
            jobs.append(self._next)
            spent += each or 0.0
            self._next = next(self._fresh, None)
        return self._chunk(jobs) if jobs else None

    def _chunk(self, jobs: list[Job], suspected: int = 0) -> Chunk:
        texts = {case: self.spec.cases[case].text for case, _ in jobs}
        return Chunk(
            self.spec.engine,
            self.spec.bits,
            texts,
            tuple(jobs),
            self._trust,
            self._folders,
            suspected,
            files(self._trust),
        )

    def finish(self, jobs: list[Job], seconds: float) -> None:
        """Note that searches have their results."""
        self.left -= len(jobs)
        if jobs:
            self.pace.note(jobs, seconds)

    def requeue(self, jobs: list[Job]) -> None:
        """Put searches back that have not started, without a charge."""
        if jobs:
            self._again.append(self._chunk(jobs))

    def suspect(self, chunk: Chunk) -> None:
        """Put a chunk back that was under way, with other chunks, when a pool broke."""
        if chunk.suspected + 1 < SUSPECT:
            self._again.append(replace(chunk, suspected=chunk.suspected + 1))
        else:
            self._again.extend(self._chunk([job], SUSPECT) for job in chunk.jobs)

    def fail(self, chunk: Chunk, reason: str) -> None:
        """Charge the search of a chunk that the executor lost; a chunk of several searches is split first."""
        if len(chunk.jobs) == 1:
            self.charge(chunk.jobs[0], reason)
        else:
            self._again.extend(self._chunk([job]) for job in chunk.jobs)

    def charge(self, job: Job, reason: str, suspected: int = 0) -> None:
        """Count a failed attempt at a search that lost its worker or met trouble; put it back, or abandon it."""
        self._attempts[job] = self._attempts.get(job, 0) + 1
        if self._attempts[job] < ATTEMPTS:
            self._again.append(self._chunk([job], suspected))
        else:
            self.lost[job] = reason
            self.left -= 1


def part(spec: Spec, shard: tuple[int, int]) -> Iterator[Job]:
    """Yield the searches of a part of a batch, in order."""
    number = 0
    for case in range(len(spec.cases)):
        for seed in spec.seeds:
            if number % shard[1] == shard[0] - 1:
                yield case, seed
            number += 1
