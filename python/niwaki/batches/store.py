"""The folder of a batch: its specs, and the segments with its results.

    spec-4be1d3a09c55f1e7.json      what is searched
    1-of-1/seg-8c1f...              results, of one run of the batch that wrote
    1-of-1/log-8c1f....jsonl        beside it: seconds, hosts, attempts, whole messages of errors

A result is found by its key. The segments are all there is; where each result lies is read again from them. Of two
records with one key the first counts, and they have to be equal. The part `3-of-16` of a batch has a folder of its own,
and one run at a time writes there. So parts of one batch are united by copying their folders into one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

from niwaki.batches.segments import HEAD, SEGMENT, Segment, records
from niwaki.batches.spec import SPEC, Spec
from niwaki.errors import InputError
from niwaki.errors.files import ensure_folder, unreadable, write_whole
from niwaki.errors.folders import held_folder
from niwaki.inputs import bytes_of


def specs(folder: Path) -> list[Spec]:
    """The specs of a folder, all with the same cases; none where there is no batch.

    Raises
    ------
    InputError
        One of them is damaged, or they are of two batches.
    """
    found = [Spec.of_file(bytes_of(place, "batch"), place) for place in _within(folder, f"{SPEC}*.json")]
    for one in found[1:]:
        refuse_another(folder, found[0], one)
    return found


def is_batch(folder: Path) -> bool:
    """Whether a folder holds a batch."""
    return bool(_within(folder, f"{SPEC}*.json"))


def _within(folder: Path, pattern: str) -> list[Path]:
    """The files of a folder by a pattern, in the order of their names."""
    with unreadable(folder, "a folder"):
        return sorted(folder.glob(pattern))


def refuse_another(folder: Path, there: Spec, given: Spec) -> None:
    """Refuse a spec whose cases differ from those of the folder; with what differs."""
    if there.identity == given.identity:
        return
    if there.engine != given.engine:
        said = "the engine of Niwaki is another one, and may give other results"
    elif there.bits != given.bits:
        said = "this machine computes other bits, and may give other results"
    elif len(there.cases) != len(given.cases):
        said = f"it has {len(there.cases)} cases, and this batch {len(given.cases)}"
    else:
        number, old, new = next(
            (number, old, new)
            for number, (old, new) in enumerate(zip(there.cases, given.cases, strict=True))
            if (dict(old.labels), old.hash) != (dict(new.labels), new.hash)
        )
        names = [name for name, value in new.about.items() if old.about.get(name) != value]
        said = f"of case {number} {', '.join(names) or 'the labels'} differ{'s' * (len(names) == 1)}"
    raise InputError("other-batch", path=folder, differences=said)


class Store:
    """The results of a batch, in its folder.

    Parameters
    ----------
    folder
        The folder.
    spec
        What is searched, where results will be written (`held` finds those that are there); that of the folder when
        left out, to read the results.

    Raises
    ------
    InputError
        There is no batch, or another one, in the folder; or two results with one key differ.
    """

    def __init__(self, folder: Path, spec: Spec | None = None) -> None:
        self.folder = folder
        there = specs(folder)
        if spec is None and not there:
            raise InputError("no-batch", path=folder)
        if spec is not None and there:
            refuse_another(folder, there[0], spec)
        self.spec = spec or there[0]
        self._is_written = any(one.asked == self.spec.asked for one in there)
        seeds = self.spec.seeds
        for one in there:
            seeds = seeds.united(one.seeds)
        #: All cases with the seeds of all specs of the folder.
        self.whole = Spec(self.spec.cases, seeds, self.spec.engine, self.spec.bits)
        self._files: list[Path] = []
        self._places: dict[bytes, tuple[int, int, int]] = {}
        if spec is None:
            self.scan()

    def scan(self) -> None:
        """Find the results that are there."""
        self._files, self._places = [], {}
        for place in _within(self.folder, f"*-of-*/{SEGMENT}*"):
            self._files.append(place)
            for key, at, length in records(place):
                self._know(key, len(self._files) - 1, at, length)

    def _know(self, key: bytes, file: int, at: int, length: int) -> None:
        """Note where a result lies; the first of two counts."""
        first = self._places.setdefault(key, (file, at, length))
        if first != (file, at, length) and self._read(first) != self._read((file, at, length)):
            raise InputError(
                "unequal-results",
                first=self._files[first[0]],
                second=self._files[file],
                key=key.hex()[:16],
            )

    def __contains__(self, key: bytes) -> bool:
        return key in self._places

    def __len__(self) -> int:
        return len(self._places)

    def body(self, key: bytes) -> bytes:
        """The bytes of a result."""
        return self._read(self._places[key])

    def _read(self, place: tuple[int, int, int]) -> bytes:
        file, at, length = place
        with unreadable(self._files[file], "a segment"), self._files[file].open("rb") as opened:
            opened.seek(at)
            return opened.read(length)

    def present(self) -> Iterator[tuple[int, int, bytes]]:
        """Case, seed and bytes of each result that is there, in the order of the batch."""
        for case in range(len(self.whole.cases)):
            for seed in self.whole.seeds:
                key = self.whole.key(case, seed)
                if key in self._places:
                    yield case, seed, self.body(key)

    def hash(self) -> str:
        """SHA-256 of all results in the order of the batch, in hexadecimal; wherever they were computed."""
        found = sha256()
        for case, seed, body in self.present():
            found.update(HEAD.pack(b"", self.whole.key(case, seed), len(body), 0) + body)
        return found.hexdigest()

    @contextmanager
    def held(self, shard: tuple[int, int] = (1, 1)) -> Iterator[Own]:
        """The folder of a part of the batch, for this run alone.

        Raises
        ------
        FileError
            Another run writes there, or the folder cannot be written to.
        """
        ensure_folder(self.folder)
        with held_folder(self.folder / f"{shard[0]}-of-{shard[1]}") as folder:
            if not self._is_written:
                text = self.spec.text().encode()
                write_whole(self.folder / Spec.name_of(text), text)
                self._is_written = True
            self.scan()
            own = Own(self, Segment(folder))
            try:
                yield own
            finally:
                own.close()


class Own:
    """What one run of a batch writes into its store."""

    def __init__(self, store: Store, segment: Segment) -> None:
        self._store, self._segment = store, segment
        self._number = len(store._files)
        store._files.append(segment.path)

    def add(self, found: Iterable[tuple[bytes, bytes]], lines: Iterable[str] = ()) -> None:
        """Add results by their keys, and lines to the log."""
        listed = list(found)
        places = self._segment.append(listed, lines)
        for (key, body), at in zip(listed, places, strict=True):
            self._store._know(key, self._number, at, len(body))

    def close(self) -> None:
        """Bring all of it to the disk."""
        self._segment.close()
