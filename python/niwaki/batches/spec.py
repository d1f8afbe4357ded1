"""What a batch consists of: cases, which are searches without a seed, and seeds. Each case is searched by each seed.

A spec is written once and is not changed: its name has the hash of its bytes, which is computed again wherever it is
read. Another spec in the same folder has the same cases and other seeds. The results depend on the engine and on the
bits that a machine computes, so both are part of it.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from itertools import accumulate
from pathlib import Path
from typing import Annotated, Any

from msgspec import Meta, Struct

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.schema import Unfit, decoded, fitted
from niwaki.errors.settings import bad, count, is_whole
from niwaki.once import cached_property
from niwaki.search import Search
from niwaki.search.request import check_format, engine_hash

#: The version of the JSON form, and of what segments hold.
FORMAT = 1

#: How the names of specs begin, and how many digits of the hash follow.
SPEC, DIGITS = "spec-", 16

#: The most searches of a batch.
MOST = 100_000_000

Whole = Annotated[int, Meta(ge=0)]


class CaseData(Struct):
    """A case as data."""

    labels: dict[str, str | int | float | bool | None]
    hash: str
    about: dict[str, Any]
    search: dict[str, Any]


class SpecData(Struct):
    """A spec as data."""

    format: int
    engine: str
    bits: str
    cases: Annotated[list[CaseData], Meta(min_length=1)]
    seeds: Annotated[list[tuple[Whole, Whole]], Meta(min_length=1)]


class Seeds(Sequence[int]):
    """Whole numbers as ranges: first number, and how many.

    >>> list(Seeds([(0, 3), (10, 1)]))
    [0, 1, 2, 10]
    """

    def __init__(self, ranges: Iterable[tuple[int, int]]) -> None:
        self.ranges = [(first, length) for first, length in ranges if length]
        self._ends = [0, *accumulate(length for _, length in self.ranges)]

    @classmethod
    def of(cls, given: Any) -> Seeds:
        """Of a number of seeds (0, 1, ...) or the seeds themselves; each once, in their order of size.

        Raises
        ------
        InputError
            They are no seeds.
        """
        if is_whole(given):
            return cls([(0, count("seeds", given, most=MOST))])
        expected, example = "a number of seeds, or seeds from 0 to 2**64 - 1", "1000, or `range(1000, 2000)`"
        if isinstance(given, str) or not isinstance(given, Iterable):
            raise bad("seeds", given, expected, example)
        if isinstance(given, range) and given.step == 1 and len(given) and 0 <= given[0] <= given[-1] < 2**64:
            return cls([(given.start, count("seeds", len(given), most=MOST))])
        ranges: list[tuple[int, int]] = []
        listed = list(given)
        if not listed or not all(is_whole(one) and 0 <= one < 2**64 for one in listed):
            raise bad("seeds", listed, expected, example)
        for one in sorted(set(listed)):
            if ranges and sum(ranges[-1]) == one:
                ranges[-1] = ranges[-1][0], ranges[-1][1] + 1
            else:
                ranges.append((one, 1))
        return cls(ranges)

    def united(self, other: Seeds) -> Seeds:
        """Those of both."""
        ranges: list[tuple[int, int]] = []
        for first, length in sorted(self.ranges + other.ranges):
            if ranges and first <= sum(ranges[-1]):
                start = ranges[-1][0]
                ranges[-1] = start, max(sum(ranges[-1]), first + length) - start
            else:
                ranges.append((first, length))
        return Seeds(ranges)

    def __len__(self) -> int:
        return self._ends[-1]

    def __iter__(self) -> Iterator[int]:
        return (one for first, length in self.ranges for one in range(first, first + length))

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[one] for one in range(*index.indices(len(self)))]
        for (first, length), end in zip(self.ranges, self._ends, strict=False):
            if 0 <= index - end < length:
                return first + index - end
        raise IndexError(index)


@dataclass(frozen=True)
class Case:
    """A search by any seed, with the values in which it differs from the other cases.

    Attributes
    ----------
    labels : dict
        Those values by name, as texts, numbers and truth values.
    hash : str
        SHA-256 of what decides its results, but for the seed.
    about : dict
        The same by name; see `Search.about`.
    data : dict
        The search as data.
    """

    labels: Mapping[str, Any]
    hash: str
    about: Mapping[str, Any]
    data: Mapping[str, Any]

    @classmethod
    def of_search(cls, search: Search, labels: Mapping[str, Any]) -> Case:
        """The case of a search, whose seed does not matter.

        Raises
        ------
        InputError
            A clock would decide the result, or there are several runs.
        """
        if getattr(search.method, "seconds", None) is not None:
            expected = "None: a clock must not decide the results of a batch, which are compared byte by byte"
            raise bad(
                "seconds",
                getattr(search.method, "seconds", None),
                expected,
                "None, and name `rounds` or counts",
            )
        if search.runs != 1:
            raise bad(
                "runs",
                search.runs,
                "1: in a batch each seed is a search of its own",
                "1, and give more `seeds`",
            )
        own = search.with_seed(0)
        return cls(dict(labels), own.hash, own.about, own.data("inside"))

    @cached_property
    def text(self) -> str:
        """The search as JSON."""
        return json.dumps(self.data, allow_nan=False)

    def search(self, trust: tuple[str, ...] = ()) -> Search:
        """The search; `trust` as for `Search.of_data`.

        Raises
        ------
        InputError
            It is none, or not that of the hash, by which results are found.
        """
        found = Search.of_data(self.data, trust).with_seed(0)
        if found.hash != self.hash:
            reason = f"its results are those of the search {self.hash[:16]}, and it has the search {found.hash[:16]}"
            raise InputError("bad-batch", path=f"the case {dict(self.labels)}", reason=reason)
        return found


@dataclass(frozen=True)
class Spec:
    """All cases, and the seeds by which each is searched.

    Attributes
    ----------
    cases : tuple of Case
        At least one.
    seeds : Seeds
        At least one.
    engine, bits : str
        SHA-256 of the compiled engine, and the fingerprint of the numbers that the machine computes.
    """

    cases: tuple[Case, ...]
    seeds: Seeds
    engine: str
    bits: str

    @classmethod
    def here(cls, cases: Iterable[Case], seeds: Seeds) -> Spec:
        """A spec for this engine and this machine."""
        own = tuple(cases)
        count("the number of searches", len(own) * len(seeds), most=MOST)
        return cls(own, seeds, engine_hash(), _engine.fingerprint())

    def __len__(self) -> int:
        return len(self.cases) * len(self.seeds)

    @property
    def identity(self) -> tuple[Any, ...]:
        """What two specs of one folder have in common: all but the seeds."""
        return self.engine, self.bits, [(dict(case.labels), case.hash) for case in self.cases]

    @property
    def asked(self) -> tuple[Any, ...]:
        """What decides which results the batch has: the cases and the seeds."""
        return *self.identity, self.seeds.ranges

    @cached_property
    def prefixes(self) -> list[bytes]:
        """What the key of a result begins with before it is hashed, by case."""
        return [f"{case.hash} {self.engine} {self.bits} ".encode() for case in self.cases]

    def key(self, case: int, seed: int) -> bytes:
        """The key of a result: SHA-256 of what decides its bytes."""
        return sha256(self.prefixes[case] + str(seed).encode()).digest()

    def data(self) -> dict[str, Any]:
        """The spec as plain data."""
        return {
            "format": FORMAT,
            "engine": self.engine,
            "bits": self.bits,
            "cases": [
                {"labels": dict(one.labels), "hash": one.hash, "about": dict(one.about), "search": one.data}
                for one in self.cases
            ],
            "seeds": self.seeds.ranges,
        }

    def text(self) -> str:
        """The spec as JSON."""
        return json.dumps(self.data(), allow_nan=False)

    @staticmethod
    def name_of(text: bytes) -> str:
        """The name of the file that has this text."""
        return f"{SPEC}{sha256(text).hexdigest()[:DIGITS]}.json"

    @classmethod
    def of_file(cls, text: bytes, place: Path) -> Spec:
        """Read a spec from the bytes of its file.

        Raises
        ------
        InputError
            It is none, or was changed.
        """
        try:
            if place.name != cls.name_of(text):
                raise InputError(
                    "bad-batch", path=place, reason="its bytes are not those that its name is the hash of"
                )
            data = decoded(text)
            check_format(data, FORMAT)
            read = fitted(data, SpecData)
            if any(first + length > 2**64 for first, length in read.seeds):
                raise Unfit("$.seeds", "seeds below 2**64", "larger ones")
        except Unfit as error:
            raise InputError("bad-batch", path=place, reason=str(error)) from error
        cases = (Case(one.labels, one.hash, one.about, one.search) for one in read.cases)
        return cls(tuple(cases), Seeds(read.seeds), read.engine, read.bits)
