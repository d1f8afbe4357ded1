"""The archive of a fit: every evaluation with its outcome and its mesh. In a folder it is cache, checkpoint and table.

The file is only appended to, record by record (`niwaki.batches.segments`): a head in JSON, then bytes. What a killed
process left incomplete is skipped when it is read, and evaluated again. The first record has the settings that decide
the outcomes; another search is refused.
"""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.batches.segments import record, records
from niwaki.errors import InputError
from niwaki.errors.files import sync_folder, unwritable, write_all
from niwaki.errors.folders import held_folder
from niwaki.fitting.draws import Drawn
from niwaki.fitting.goals import Outcome
from niwaki.fitting.loop import Failure
from niwaki.search.checkpoint import differences
from niwaki.search.data import text_hash

#: The name of the file in its folder, and the version of its records.
NAME, FORMAT = "archive.fit", 1


@dataclass(frozen=True)
class Entry:
    """One evaluation.

    Attributes
    ----------
    number : int
        Its place in the order of asking, from 0.
    numbers : dict
        The point as plain numbers, by name.
    outcome : Outcome or Failure
        What came of it.
    kind : str
        "" for a mesh; "raised", "died" or "time-out".
    seconds : float
        Wall time of the call.
    defects : tuple of str
        What is wrong with its mesh.
    drawn : tuple of Drawn
        The draws of a function that is defined by run.
    mesh : bytes
        Its packed mesh; empty for a failure.
    """

    number: int
    numbers: dict[str, float]
    outcome: Outcome | Failure
    kind: str = ""
    seconds: float = 0.0
    defects: tuple[str, ...] = ()
    drawn: tuple[Drawn, ...] = ()
    mesh: bytes = b""

    @property
    def arrays(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Vertices and faces of its mesh."""
        return unpacked(self.mesh)


@dataclass(frozen=True)
class Repeat:
    """A second call of a point, which tells whether the generator is deterministic.

    Attributes
    ----------
    number : int
        The point.
    score : float
        The log score of the second mesh; minus infinity for a failure.
    is_equal : bool
        Whether both meshes have the same bits.
    """

    number: int
    score: float
    is_equal: bool


def packed(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> bytes:
    """Pack a mesh."""
    head = np.array([len(vertices), len(faces)], "<i8").tobytes()
    corners = faces.astype("<i4") if len(vertices) < 2**31 else faces
    return zlib.compress(head + np.ascontiguousarray(vertices, "<f8").tobytes() + corners.tobytes(), 1)


def unpacked(data: bytes) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Unpack a mesh; empty arrays from no bytes."""
    if not data:
        return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    raw = zlib.decompress(data)
    points, triangles = (int(count) for count in np.frombuffer(raw[:16], "<i8"))
    cut = 16 + 24 * points
    kind = "<i4" if points < 2**31 else "<i8"
    vertices = np.frombuffer(raw[16:cut], "<f8").reshape(-1, 3)
    return vertices, np.frombuffer(raw[cut:], kind).reshape(-1, 3)[:triangles].astype(np.int64)


class Archive:
    """The evaluations of one search, in memory and perhaps in a folder.

    Attributes
    ----------
    entries : dict of int to Entry
        Evaluations by number.
    probes : dict of int to tuple of Drawn
        Draws of the runs that show the parameters of a function that is defined by run.
    repeats : dict of int to Repeat
        Second calls by the number of their point.
    """

    def __init__(self) -> None:
        self.entries: dict[int, Entry] = {}
        self.probes: dict[int, tuple[Drawn, ...]] = {}
        self.repeats: dict[int, Repeat] = {}
        self._file: int | None = None
        self._place: Path | None = None

    def add(self, entry: Entry) -> None:
        """Add an evaluation."""
        self.entries[entry.number] = entry
        head = asdict(entry) | {"record": "point", "mesh": len(entry.mesh)}
        body = b""
        if isinstance(entry.outcome, Outcome):
            body = np.ascontiguousarray(entry.outcome.features, "<f4").tobytes()
            head["outcome"] = asdict(entry.outcome) | {"features": len(body)}
        self._append(head, body + entry.mesh)

    def add_probe(self, number: int, drawn: tuple[Drawn, ...]) -> None:
        """Add the draws of a run at random."""
        self.probes[number] = drawn
        self._append({"record": "probe", "number": number, "drawn": [asdict(row) for row in drawn]})

    def add_repeat(self, repeat: Repeat) -> None:
        """Add a second call."""
        self.repeats[repeat.number] = repeat
        self._append({"record": "repeat", **asdict(repeat)})

    def _append(self, head: Mapping[str, Any], body: bytes = b"") -> None:
        if self._file is None or self._place is None:
            return
        data = json.dumps(head).encode() + b"\n" + body
        try:
            write_all(self._file, record(bytes.fromhex(text_hash(json.dumps(head)[:200])), data))
        except OSError as error:
            raise unwritable(self._place, error) from error

    def _read(self, place: Path, about: Mapping[str, Any] | None) -> dict[str, Any] | None:
        """Read the records of a file; return the stored settings."""
        stored: dict[str, Any] | None = None
        try:
            data = place.read_bytes() if place.exists() else b""
            for _, start, length in records(place) if data else ():
                line, _, body = data[start : start + length].partition(b"\n")
                head = json.loads(line)
                kind = head.pop("record")
                if kind == "about":
                    stored = head
                    if about is None:
                        return stored
                    _refuse_another(place, stored, about)
                elif kind == "probe":
                    self.probes[head["number"]] = _drawn(head["drawn"])
                elif kind == "repeat":
                    self.repeats[head["number"]] = Repeat(**head)
                else:
                    self._read_point(head, body)
        except (ValueError, KeyError, TypeError) as error:
            raise InputError("bad-archive", path=place, reason=f"{type(error).__name__}: {error}") from error
        if data and stored is None:
            raise InputError("bad-archive", path=place, reason="it has no settings of a fit")
        return stored

    def _read_point(self, head: dict[str, Any], body: bytes) -> None:
        size = head["mesh"]
        data, mesh = body[: len(body) - size], body[len(body) - size :]
        outcome: Outcome | Failure
        if "text" in head["outcome"]:
            outcome = Failure(**head["outcome"])
        else:
            features = np.frombuffer(data, "<f4", head["outcome"]["features"] // 4).copy()
            outcome = Outcome(**{**head["outcome"], "features": features})
        entry = Entry(
            **{
                **head,
                "outcome": outcome,
                "defects": tuple(head["defects"]),
                "drawn": _drawn(head["drawn"]),
                "mesh": mesh,
            }
        )
        self.entries[entry.number] = entry


def stored_settings(folder: Path) -> dict[str, Any] | None:
    """Return the settings of the archive of a folder; None without one."""
    place = folder / NAME
    return Archive()._read(place, None) if place.exists() else None


@contextmanager
def opened(folder: Path | None, about: Mapping[str, Any]) -> Iterator[Archive]:
    """Open the archive of a folder, or one in memory.

    Raises
    ------
    InputError
        `other-fit`: the folder has the archive of another search; `bad-archive`.
    FileError
        `folder-in-use`: another process writes to the folder.
    """
    archive = Archive()
    if folder is None:
        yield archive
        return
    settings = json.loads(json.dumps({**about, **_machine()}))
    with held_folder(folder):
        place = folder / NAME
        stored = archive._read(place, settings)
        try:
            file = os.open(place, os.O_WRONLY | os.O_CREAT | os.O_APPEND | getattr(os, "O_BINARY", 0), 0o666)
            sync_folder(folder)
        except OSError as error:
            raise unwritable(place, error) from error
        archive._file, archive._place = file, place
        try:
            if stored is None:
                archive._append({"record": "about", **settings})
            yield archive
        finally:
            archive._file = None
            os.fsync(file)
            os.close(file)


def _machine() -> dict[str, Any]:
    return {
        "the version of Niwaki": _engine.__version__,
        "the machine": _engine.fingerprint(),
        "the version of the archive": FORMAT,
    }


def _refuse_another(place: Path, stored: Mapping[str, Any], about: Mapping[str, Any]) -> None:
    texts = differences(stored, about)
    if texts:
        raise InputError("other-fit", path=place.parent, differences="; ".join(texts))


def _drawn(rows: Any) -> tuple[Drawn, ...]:
    return tuple(Drawn(**{**row, "labels": tuple(row["labels"])}) for row in rows)
