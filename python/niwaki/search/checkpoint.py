"""Checkpoints: what a search or a training needs to go on after it was killed, as one file.

The first line names the format, its version and the SHA-256 of everything after it. The second is a table in JSON:
what the checkpoint is of, a note, and the names and lengths of its parts, which follow as they are. The file is
written whole; nothing in it is run.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.files import ensure_folder, write_whole
from niwaki.errors.settings import bad, is_number
from niwaki.inputs import bytes_of
from niwaki.search.data import MALFORMED

#: The version of the format, and of what the parts hold.
FORMAT = 1

#: The first words of the file.
MAGIC = "niwaki checkpoint"

#: Characters of what an error says that are shown.
LONGEST = 200

#: Values of at most so many characters are named where two searches differ.
SHORT = 40


@dataclass(frozen=True)
class Checkpoint:
    """Where a search keeps what it needs to go on after it was killed.

    Parameters
    ----------
    path
        The file. A search whose checkpoint is there goes on from it.
    every
        About so many seconds pass between two writes, and more where writing takes long: at most a fiftieth of the
        time is spent on it.
    keep
        Whether the file stays when the search is done.
    note
        Plain data that is written with it.
    """

    path: str | PathLike[str]
    every: float = 1.0
    keep: bool = True
    note: Any = None

    def __post_init__(self) -> None:
        """Check the settings."""
        if not is_number(self.every) or not self.every >= 0.0:
            raise bad("every", self.every, "a number of seconds, 0 or more", "1.0")

    @classmethod
    def of(cls, given: Checkpoint | str | PathLike[str]) -> Checkpoint:
        """The checkpoint of a path, or one as it is."""
        return given if isinstance(given, Checkpoint) else cls(given)


@dataclass
class Stored:
    """What a checkpoint's file holds.

    Attributes
    ----------
    kind : str
        "search" or "training".
    about : dict
        What decides the result, by name: values, or their hashes.
    note : object
        Plain data: the search, and that of whoever writes the file.
    parts : dict of str to bytes
        What there is to go on from.
    """

    kind: str
    about: dict[str, Any]
    note: Any = None
    parts: dict[str, bytes] = field(default_factory=dict)

    def bytes(self) -> bytes:
        """The file's content."""
        table = {
            "kind": self.kind,
            "about": self.about,
            "note": self.note,
            "parts": [[name, len(part)] for name, part in self.parts.items()],
        }
        rest = b"".join([json.dumps(table).encode(), b"\n", *self.parts.values()])
        return f"{MAGIC} {FORMAT} {hashlib.sha256(rest).hexdigest()}\n".encode() + rest

    def write(self, path: Path) -> None:
        """Write the file, in a folder that is created where it is missing."""
        write_whole(ensure_folder(path.parent) / path.name, self.bytes())

    @classmethod
    def read(cls, path: Path) -> Stored:
        """Read a file.

        Raises
        ------
        InputError
            It is no checkpoint, one of another version, or damaged.
        FileError
            The file cannot be read, or is too large (`inputs.limits`).
        """

        def refused(reason: str) -> InputError:
            return InputError("bad-checkpoint", detail=f"`{path}`: {reason}")

        first, _, rest = bytes_of(path, "checkpoint").partition(b"\n")
        words = first.decode("ascii", "replace").rsplit(" ", 2)
        if len(words) != 3 or words[0] != MAGIC:
            raise refused("it is no checkpoint")
        if words[1] != str(FORMAT):
            raise refused(f"it has version {words[1]}, this version of Niwaki reads {FORMAT}")
        if words[2] != hashlib.sha256(rest).hexdigest():
            raise refused("it is damaged: its bytes are not those that were written")
        head, _, body = rest.partition(b"\n")
        try:
            table = json.loads(head)
            parts, at = dict[str, bytes](), 0
            for name, length in table["parts"]:
                parts[str(name)], at = body[at : at + length], at + length
            return cls(str(table["kind"]), dict(table["about"]), table["note"], parts)
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise refused(f"its table is not that of a checkpoint: {error!r}") from error


@contextmanager
def understood(path: Path) -> Iterator[None]:
    """Inside, what a checkpoint holds is read; what no search has written there is an error about the file.

    Raises
    ------
    InputError
        `bad-checkpoint`.
    """
    try:
        yield
    except (*MALFORMED, _engine.EngineFault) as error:
        said = " ".join(f"{type(error).__name__}: {error}".split())[:LONGEST]
        raise InputError(
            "bad-checkpoint", detail=f"`{path}`: a part of it is none of a search ({said})"
        ) from error


def opened(path: Path, kind: str, about: Mapping[str, Any]) -> Stored:
    """The checkpoint of a file, or an empty one where there is no file.

    Raises
    ------
    InputError
        The file is no checkpoint, damaged, of another version, or of something else; with what differs.
    """
    own = {**about, "the version of Niwaki": _engine.__version__, "the machine": _engine.fingerprint()}
    own = json.loads(json.dumps(own))
    # A name that no file can have is refused where it is written.
    if not os.path.exists(path):
        return Stored(kind, own)
    found = Stored.read(path)
    if found.kind != kind:
        raise InputError("bad-checkpoint", detail=f"`{path}`: it is of a {found.kind}, not of a {kind}")
    differ = [name for name in own if found.about.get(name) != own[name]]
    if differ:
        said = "; ".join(_difference(name, found.about.get(name), own[name]) for name in differ)
        raise InputError("other-checkpoint", path=path, kind=kind, differences=said)
    return found


def _difference(name: str, then: Any, now: Any) -> str:
    """What differs between then and now."""
    texts = [value if isinstance(value, str) else json.dumps(value) for value in (then, now)]
    if any(len(text) > SHORT for text in texts):
        return f"{name} differs"
    return f"{name} was {texts[0]} and is {texts[1]}"


def begun_seed(seed: int | None, given: Checkpoint | str | PathLike[str] | None) -> int | None:
    """The seed, or where none is given that of the search or training that a checkpoint is of."""
    if seed is not None or given is None or not os.path.exists(Checkpoint.of(given).path):
        return seed
    found = Stored.read(Path(Checkpoint.of(given).path)).about.get("its `seed`")
    return found if isinstance(found, int) else None
