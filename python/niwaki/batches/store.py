"""The folder of a batch: its specs, and the segments with its results.

    spec-4be1d3a09c55f1e7.json      cases and seeds
    1-of-1/seg-8c1f...              results of one call of the batch
    1-of-1/log-8c1f....jsonl        its log: seconds, hosts, attempts, complete messages of errors

A result is found by its key. There is no index: the places of results are read from the segments. Two records with the
same key must be equal, and the first counts. The part `3-of-16` of a batch has a folder of its own, and one call at a
time writes there. To unite the parts of a batch, copy their folders into one.
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
    """Return the specs of a folder, which all have the same cases; an empty list without a batch.

    Raises
    ------
    InputError
        A spec is damaged, or the specs belong to different batches.
    """
    stored = [Spec.of_file(bytes_of(place, "batch"), place) for place in _within(folder, f"{SPEC}*.json")]
    for spec in stored[1:]:
        refuse_another(folder, stored[0], spec)
    return stored


def is_batch(folder: Path) -> bool:
    """Return whether a folder contains a batch."""
    return bool(_within(folder, f"{SPEC}*.json"))


def _within(folder: Path, pattern: str) -> list[Path]:
    """Return the files of a folder that match a pattern, sorted by name."""
    with unreadable(folder, "a folder"):
        return sorted(folder.glob(pattern))


def refuse_another(folder: Path, stored: Spec, spec: Spec) -> None:
    """Refuse a spec whose engine, bits or cases differ from the folder's; the error names the difference."""
    if stored.identity == spec.identity:
        return
    if stored.engine != spec.engine:
        difference = "it has results of another engine of Niwaki, which may differ"
    elif stored.bits != spec.bits:
        difference = "it has results of a machine that computes other bits"
    elif len(stored.cases) != len(spec.cases):
        difference = f"it has {len(stored.cases)} cases, and this batch {len(spec.cases)}"
    else:
        number, old, new = next(
            (number, old, new)
            for number, (old, new) in enumerate(zip(stored.cases, spec.cases, strict=True))
            if (dict(old.labels), old.hash) != (dict(new.labels), new.hash)
        )
        names = [name for name, value in new.about.items() if old.about.get(name) != value]
        difference = f"in case {number} {', '.join(names) or 'the labels'} differ{'s' * (len(names) == 1)}"
    raise InputError("other-batch", path=folder, differences=difference)


class Store:
    """The results of a batch, in its folder.

    Parameters
    ----------
    folder
        The folder.
    spec
        The spec of a batch that will write results (`writer` finds the existing ones). Default: the spec of the folder,
        to read its results.

    Raises
    ------
    InputError
        The folder has no batch, or another batch; or two results with the same key differ.
    """

    def __init__(self, folder: Path, spec: Spec | None = None) -> None:
        self.folder = folder
        stored = specs(folder)
        if spec is None and not stored:
            raise InputError("no-batch", path=folder)
        if spec is not None and stored:
            refuse_another(folder, stored[0], spec)
        self.spec = spec or stored[0]
        self._is_written = any(known.contents == self.spec.contents for known in stored)
        seeds = self.spec.seeds
        for known in stored:
            seeds = seeds.united(known.seeds)
        #: All cases, with the seeds of all specs of the folder.
        self.whole = Spec(self.spec.cases, seeds, self.spec.engine, self.spec.bits)
        self._files: list[Path] = []
        self._places: dict[bytes, tuple[int, int, int]] = {}
        if spec is None:
            self.scan()

    def scan(self) -> None:
        """Find the results in the folder."""
        self._files, self._places = [], {}
        for place in _within(self.folder, f"*-of-*/{SEGMENT}*"):
            self._files.append(place)
            for key, at, length in records(place):
                self._note(key, len(self._files) - 1, at, length)

    def _note(self, key: bytes, file: int, at: int, length: int) -> None:
        """Note the place of a result; of two results with the same key the first counts."""
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
        """Return the bytes of a result."""
        return self._read(self._places[key])

    def _read(self, place: tuple[int, int, int]) -> bytes:
        file, at, length = place
        with unreadable(self._files[file], "a segment"), self._files[file].open("rb") as opened:
            opened.seek(at)
            return opened.read(length)

    def present(self) -> Iterator[tuple[int, int, bytes]]:
        """Yield case, seed and bytes of each result, in the order of the batch."""
        for case in range(len(self.whole.cases)):
            for seed in self.whole.seeds:
                key = self.whole.key(case, seed)
                if key in self._places:
                    yield case, seed, self.body(key)

    def hash(self) -> str:
        """Return SHA-256 of all results in the order of the batch, in hexadecimal."""
        digest = sha256()
        for case, seed, body in self.present():
            digest.update(HEAD.pack(b"", self.whole.key(case, seed), len(body), 0) + body)
        return digest.hexdigest()

    @contextmanager
    def writer(self, shard: tuple[int, int] = (1, 1)) -> Iterator[StoreWriter]:
        """Yield a writer for a part of the batch, whose folder is locked.

        Raises
        ------
        FileError
            Another process writes to the folder, or it cannot be written to.
        """
        ensure_folder(self.folder)
        with held_folder(self.folder / f"{shard[0]}-of-{shard[1]}") as folder:
            if not self._is_written:
                text = self.spec.text().encode()
                write_whole(self.folder / Spec.name_of(text), text)
                self._is_written = True
            self.scan()
            writer = StoreWriter(self, Segment(folder))
            try:
                yield writer
            finally:
                writer.close()


class StoreWriter:
    """A writer of results into a store, with a segment of its own."""

    def __init__(self, store: Store, segment: Segment) -> None:
        self._store, self._segment = store, segment
        self._number = len(store._files)
        store._files.append(segment.path)

    def add(self, entries: Iterable[tuple[bytes, bytes]], lines: Iterable[str] = ()) -> None:
        """Add results with their keys, and lines of the log."""
        added = list(entries)
        places = self._segment.append(added, lines)
        for (key, body), at in zip(added, places, strict=True):
            self._store._note(key, self._number, at, len(body))

    def close(self) -> None:
        """Flush, fsync and close the segment and its log."""
        self._segment.close()
