"""Specs of batches: cases, which are searches without a seed, and seeds. Each case is searched with each seed.

A spec is written once and never changed: its file name contains the hash of its bytes, which each reader checks.
Another spec in the same folder has the same cases and other seeds. Results depend on the engine and on the bits that a
machine computes, so a spec contains both.
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

#: The version of the JSON form, and of the contents of segments.
FORMAT = 1

#: Prefix of the names of specs, and number of digits of the hash after it.
SPEC, DIGITS = "spec-", 16

#: Most searches of a batch.
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
    """Seeds as ranges: the first number, and the length.

    >>> list(Seeds([(0, 3), (10, 1)]))
    [0, 1, 2, 10]
    """

    def __init__(self, ranges: Iterable[tuple[int, int]]) -> None:
        self.ranges = [(first, length) for first, length in ranges if length]
        self._ends = [0, *accumulate(length for _, length in self.ranges)]

    @classmethod
    def of(cls, value: Any) -> Seeds:
        """Return the seeds of a number (0, 1, ...) or of a collection, sorted and without repetition.

        Raises
        ------
        InputError
            The value is not a number or a collection of seeds.
        """
        if is_whole(value):
            return cls([(0, count("seeds", value, most=MOST))])
        expected, example = "a number of seeds, or seeds from 0 to 2**64 - 1", "1000, or `range(1000, 2000)`"
        if isinstance(value, str) or not isinstance(value, Iterable):
            raise bad("seeds", value, expected, example)
        if isinstance(value, range) and value.step == 1 and len(value) and 0 <= value[0] <= value[-1] < 2**64:
            return cls([(value.start, count("seeds", len(value), most=MOST))])
        ranges: list[tuple[int, int]] = []
        listed = list(value)
        if not listed or not all(is_whole(seed) and 0 <= seed < 2**64 for seed in listed):
            raise bad("seeds", listed, expected, example)
        for seed in sorted(set(listed)):
            if ranges and sum(ranges[-1]) == seed:
                ranges[-1] = ranges[-1][0], ranges[-1][1] + 1
            else:
                ranges.append((seed, 1))
        return cls(ranges)

    def united(self, other: Seeds) -> Seeds:
        """Return the seeds of both."""
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
        return (seed for first, length in self.ranges for seed in range(first, first + length))

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[position] for position in range(*index.indices(len(self)))]
        for (first, length), end in zip(self.ranges, self._ends, strict=False):
            if 0 <= index - end < length:
                return first + index - end
        raise IndexError(index)


@dataclass(frozen=True)
class Case:
    """A search without its seed, with the values in which it differs from the other cases.

    Attributes
    ----------
    labels : dict
        The differing values by name, as texts, numbers and truth values.
    hash : str
        SHA-256 of everything that determines the results, except the seed.
    about : dict
        Hashes of the parts of the search, by name; see `Search.about`.
    data : dict
        The search as data.
    """

    labels: Mapping[str, Any]
    hash: str
    about: Mapping[str, Any]
    data: Mapping[str, Any]

    @classmethod
    def of_search(cls, search: Search, labels: Mapping[str, Any]) -> Case:
        """Return the case of a search; its seed is ignored.

        Raises
        ------
        InputError
            The result depends on a clock, or the search has several runs.
        """
        if getattr(search.method, "seconds", None) is not None:
            expected = "None: results of a batch are compared byte by byte, and must not depend on a clock"
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
                "1: in a batch each seed is a separate search",
                "1, and use more `seeds`",
            )
        seedless = search.with_seed(0)
        return cls(dict(labels), seedless.hash, seedless.about, seedless.data("inside"))

    @cached_property
    def text(self) -> str:
        """The search as JSON."""
        return json.dumps(self.data, allow_nan=False)

    def search(self, trust: tuple[str, ...] = ()) -> Search:
        """Return the search; see `Search.of_data` for `trust`.

        Raises
        ------
        InputError
            The data is not a search, or its hash differs from the hash of the results.
        """
        search = Search.of_data(self.data, trust).with_seed(0)
        if search.hash != self.hash:
            reason = f"its results belong to the search {self.hash[:16]}, but it contains the search {search.hash[:16]}"
            raise InputError("bad-batch", path=f"the case {dict(self.labels)}", reason=reason)
        return search


@dataclass(frozen=True)
class Spec:
    """The cases of a batch, and the seeds for each case.

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
        """Return a spec for this engine and this machine."""
        case_list = tuple(cases)
        count("the number of searches", len(case_list) * len(seeds), most=MOST)
        return cls(case_list, seeds, engine_hash(), _engine.fingerprint())

    def __len__(self) -> int:
        return len(self.cases) * len(self.seeds)

    @property
    def identity(self) -> tuple[Any, ...]:
        """The engine, bits and cases, which all specs of a folder share."""
        return self.engine, self.bits, [(dict(case.labels), case.hash) for case in self.cases]

    @property
    def contents(self) -> tuple[Any, ...]:
        """The identity and the seeds, which determine the results of the batch."""
        return *self.identity, self.seeds.ranges

    @cached_property
    def prefixes(self) -> list[bytes]:
        """The first part of a result's key, before it is hashed, for each case."""
        return [f"{case.hash} {self.engine} {self.bits} ".encode() for case in self.cases]

    def key(self, case: int, seed: int) -> bytes:
        """Return the key of a result: SHA-256 of everything that determines its bytes."""
        return sha256(self.prefixes[case] + str(seed).encode()).digest()

    def data(self) -> dict[str, Any]:
        """Return the spec as plain data."""
        return {
            "format": FORMAT,
            "engine": self.engine,
            "bits": self.bits,
            "cases": [
                {
                    "labels": dict(case.labels),
                    "hash": case.hash,
                    "about": dict(case.about),
                    "search": case.data,
                }
                for case in self.cases
            ],
            "seeds": self.seeds.ranges,
        }

    def text(self) -> str:
        """Return the spec as JSON."""
        return json.dumps(self.data(), allow_nan=False)

    @staticmethod
    def name_of(text: bytes) -> str:
        """Return the name of the file with this text."""
        return f"{SPEC}{sha256(text).hexdigest()[:DIGITS]}.json"

    @classmethod
    def of_file(cls, text: bytes, place: Path) -> Spec:
        """Read a spec from the bytes of its file.

        Raises
        ------
        InputError
            The file is not a spec, or its bytes have changed.
        """
        try:
            if place.name != cls.name_of(text):
                raise InputError("bad-batch", path=place, reason="its bytes do not have the hash in its name")
            data = decoded(text)
            check_format(data, FORMAT)
            read = fitted(data, SpecData)
            if any(first + length > 2**64 for first, length in read.seeds):
                raise Unfit("$.seeds", "seeds below 2**64", "larger ones")
        except Unfit as error:
            raise InputError("bad-batch", path=place, reason=str(error)) from error
        cases = (Case(case.labels, case.hash, case.about, case.search) for case in read.cases)
        return cls(tuple(cases), Seeds(read.seeds), read.engine, read.bits)
