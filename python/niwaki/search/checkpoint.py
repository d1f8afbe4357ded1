"""Files of checkpoints, from which a search or a training resumes after its process was killed.

The first line has the format, its version and the SHA-256 of everything after it. The second line is a table in JSON:
the settings of the search or training, a note, and the names and lengths of the parts. The bytes of the parts follow.
The file is written whole; reading it runs no code.
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

#: The version of the format and of its parts.
FORMAT = 1

#: The first words of the file.
MAGIC = "niwaki checkpoint"

#: The most characters of an error that a message shows.
LONGEST = 200

#: The most characters of a value that a message about another search shows.
SHORT = 40


@dataclass(frozen=True)
class Checkpoint:
    """File from which a search resumes after its process was killed.

    Parameters
    ----------
    path
        The file. A search resumes from it if it exists.
    every
        Approximate seconds between two writes; more if writing takes long, so that it takes at most a fiftieth of
        the time.
    keep
        Whether the file stays after the end of the search.
    note
        Plain data, which is written to the file.
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
    def of(cls, checkpoint: Checkpoint | str | PathLike[str]) -> Checkpoint:
        """Make a checkpoint of a path; return a checkpoint unchanged."""
        return checkpoint if isinstance(checkpoint, Checkpoint) else cls(checkpoint)


@dataclass
class Stored:
    """Content of a checkpoint's file.

    Attributes
    ----------
    kind : str
        "search" or "training".
    about : dict
        The settings that decide the result, by name: values, or their hashes.
    note : object
        Plain data: the search, and the note of the `Checkpoint`.
    parts : dict of str to bytes
        The states of running stages, and the results of finished ones.
    """

    kind: str
    about: dict[str, Any]
    note: Any = None
    parts: dict[str, bytes] = field(default_factory=dict)

    def bytes(self) -> bytes:
        """The bytes of the file."""
        table = {
            "kind": self.kind,
            "about": self.about,
            "note": self.note,
            "parts": [[name, len(part)] for name, part in self.parts.items()],
        }
        rest = b"".join([json.dumps(table).encode(), b"\n", *self.parts.values()])
        return f"{MAGIC} {FORMAT} {hashlib.sha256(rest).hexdigest()}\n".encode() + rest

    def write(self, path: Path) -> None:
        """Write the file; create its folder if it is missing."""
        write_whole(ensure_folder(path.parent) / path.name, self.bytes())

    @classmethod
    def read(cls, path: Path) -> Stored:
        """Read a file.

        Raises
        ------
        InputError
            The file is no checkpoint, of another version, or damaged.
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
def reading(path: Path) -> Iterator[None]:
    """Context in which parts of a checkpoint are read: malformed data raise an error about the file.

    Raises
    ------
    InputError
        `bad-checkpoint`: the data are not what a search writes.
    """
    try:
        yield
    except (*MALFORMED, _engine.EngineFault) as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:LONGEST]
        raise InputError(
            "bad-checkpoint", detail=f"`{path}`: no search has written one of its parts ({reason})"
        ) from error


def open_file(path: Path, kind: str, about: Mapping[str, Any]) -> Stored:
    """Read the checkpoint of a file, or make an empty one if there is no file.

    Parameters
    ----------
    path
        The file.
    kind, about
        The kind and the settings of the search or training, as in `Stored`.

    Raises
    ------
    InputError
        The file is no checkpoint, damaged, of another version, or of another search; the message names the differences.
    """
    settings = {**about, "the version of Niwaki": _engine.__version__, "the machine": _engine.fingerprint()}
    settings = json.loads(json.dumps(settings))
    # A name that no file can have is refused where the file is written.
    if not os.path.exists(path):
        return Stored(kind, settings)
    stored = Stored.read(path)
    if stored.kind != kind:
        raise InputError(
            "bad-checkpoint", detail=f"`{path}`: it is the checkpoint of a {stored.kind}, not of a {kind}"
        )
    if texts := differences(stored.about, settings):
        raise InputError("other-checkpoint", path=path, kind=kind, differences="; ".join(texts))
    return stored


def differences(then: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """The differences between stored settings and those of now, in words."""
    return [_difference(name, then.get(name), now[name]) for name in now if then.get(name) != now[name]]


def _difference(name: str, then: Any, now: Any) -> str:
    """The difference between two values of a setting."""
    texts = [value if isinstance(value, str) else json.dumps(value) for value in (then, now)]
    if any(len(text) > SHORT for text in texts):
        return f"{name} differs"
    return f"{name} was {texts[0]} and is {texts[1]}"


def resumed_seed(seed: int | None, checkpoint: Checkpoint | str | PathLike[str] | None) -> int | None:
    """The seed; without one, the seed of the search or training of a checkpoint."""
    if seed is not None or checkpoint is None or not os.path.exists(Checkpoint.of(checkpoint).path):
        return seed
    stored = Stored.read(Path(Checkpoint.of(checkpoint).path)).about.get("its `seed`")
    return stored if isinstance(stored, int) else None
