"""Which searches of a batch are missing, and how many of them make a chunk.

A chunk that is too small costs more than it does, and one that is too large is lost with its worker and leaves the
others idle at the end. So a chunk takes about the seconds that are asked for, by what searches have taken so far, and
less when little is left.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator
from dataclasses import replace

from niwaki.batches.spec import Spec
from niwaki.batches.store import Store
from niwaki.batches.working import Chunk
from niwaki.errors.settings import bad, is_whole
from niwaki.inputs.modules import files

#: Seconds of the smallest chunk, at the end of a batch.
LEAST = 0.1

#: Most searches of a chunk: what is lost with a worker, and sent at once.
MOST = 5_000

#: The weight of the last chunk in the mean of seconds.
FRESH = 0.3

#: So often a search is tried whose worker is lost, or has trouble.
ATTEMPTS = 3

#: A chunk that was under way so often when a pool broke is done alone, to know whether it breaks it.
SUSPECT = 2

Item = tuple[int, int]


def shard_of(given: str | tuple[int, int] | None) -> tuple[int, int]:
    """The part of a batch: `(3, 16)` or "3/16", the third of sixteen.

    Raises
    ------
    InputError
        It is none.
    """
    found = re.fullmatch(r"(\d{1,7})/(\d{1,7})", given) if isinstance(given, str) else None
    parts = (1, 1) if given is None else tuple(map(int, found.groups())) if found else given
    if not isinstance(parts, tuple) or len(parts) != 2 or not all(map(is_whole, parts)):
        raise bad("shard", given, "a part and the number of parts", "3/16, the third of sixteen")
    if not 1 <= parts[0] <= parts[1]:
        raise bad(
            "shard", given, "a part from 1 to the number of parts", f"1/{max(parts[1], 1)}, the first of them"
        )
    return parts


class Pace:
    """Seconds that a search takes, measured as a batch goes on."""

    def __init__(self) -> None:
        self._mean: float | None = None
        self._of_case: dict[int, float] = {}

    def note(self, items: list[Item], seconds: float) -> None:
        """A chunk took so many seconds of a worker."""
        each = seconds / len(items)
        for case in {case for case, _ in items}:
            self._of_case[case] = _mixed(self._of_case.get(case), each)
        self._mean = _mixed(self._mean, each)

    def of(self, case: int) -> float | None:
        """Seconds of a search of a case; None while nothing is known."""
        return self._of_case.get(case, self._mean)

    @property
    def mean(self) -> float:
        """Seconds of a search of any case."""
        return self._mean or 0.0


def _mixed(old: float | None, new: float) -> float:
    return new if old is None else (1.0 - FRESH) * old + FRESH * new


class Plan:
    """The searches that are left to do.

    Parameters
    ----------
    store
        What is there already.
    shard
        The part of the batch: every so many-th search.
    target
        Seconds of a chunk.
    trust, folders
        As for `Chunk`.
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
        self._attempts: dict[Item, int] = {}
        self.pace = Pace()
        self.left = sum(1 for _ in self._missing())
        #: Searches that were given up, and why.
        self.lost: dict[Item, str] = {}

    def _missing(self) -> Iterator[Item]:
        return (item for item in part(self.spec, self._shard) if self.spec.key(*item) not in self._store)

    def attempt(self, item: Item) -> int:
        """Which attempt at a search is under way, from 1."""
        return self._attempts.get(item, 0) + 1

    def take(self, workers: int, alone: bool) -> Chunk | None:
        """The next chunk for a worker; None where there is nothing to do at present.

        Parameters
        ----------
        workers
            How many share what is left.
        alone
            Whether nothing else is under way.
        """
        if self._again:
            if self._again[0].suspected < SUSPECT or alone:
                return self._again.popleft()
            return None
        seconds = min(self._target, max(LEAST, self.left * self.pace.mean / (4 * workers)))
        items, spent = list[Item](), 0.0
        while self._next is not None and len(items) < MOST:
            each = self.pace.of(self._next[0])
            if items and (each is None or spent + each > seconds):
                break
            items.append(self._next)
            spent += each or 0.0
            self._next = next(self._fresh, None)
        return self._chunk(items) if items else None

    def _chunk(self, items: list[Item], suspected: int = 0) -> Chunk:
        texts = {case: self.spec.cases[case].text for case, _ in items}
        return Chunk(
            self.spec.engine,
            self.spec.bits,
            texts,
            tuple(items),
            self._trust,
            self._folders,
            suspected,
            files(self._trust),
        )

    def done(self, items: list[Item], seconds: float) -> None:
        """These searches have their results."""
        self.left -= len(items)
        if items:
            self.pace.note(items, seconds)

    def again(self, items: list[Item]) -> None:
        """These were not begun, through no fault of theirs."""
        if items:
            self._again.append(self._chunk(items))

    def suspect(self, chunk: Chunk) -> None:
        """A pool broke while this chunk was under way with others: perhaps by it, and more likely not."""
        if chunk.suspected + 1 < SUSPECT:
            self._again.append(replace(chunk, suspected=chunk.suspected + 1))
        else:
            self._again.extend(self._chunk([item], SUSPECT) for item in chunk.items)

    def failed(self, chunk: Chunk, reason: str) -> None:
        """The executor lost this chunk alone; a chunk of several searches is taken apart before one is charged."""
        if len(chunk.items) == 1:
            self.charge(chunk.items[0], reason)
        else:
            self._again.extend(self._chunk([item]) for item in chunk.items)

    def charge(self, item: Item, reason: str, suspected: int = 0) -> None:
        """A search lost its worker, or met trouble: it is tried again, or given up."""
        self._attempts[item] = self._attempts.get(item, 0) + 1
        if self._attempts[item] < ATTEMPTS:
            self._again.append(self._chunk([item], suspected))
        else:
            self.lost[item] = reason
            self.left -= 1


def part(spec: Spec, shard: tuple[int, int]) -> Iterator[Item]:
    """The searches of a part of a batch, in order."""
    number = 0
    for case in range(len(spec.cases)):
        for seed in spec.seeds:
            if number % shard[1] == shard[0] - 1:
                yield case, seed
            number += 1
