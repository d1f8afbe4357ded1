"""Faults of the disk, one at each call in turn: what is stored must come through all of them.

    for trial in trials(tmp_path, attempt):
        assert trial.error is None or isinstance(trial.error, FileError), trial
        assert whole(trial.folder), trial

`attempt(folder)` stores something in a folder that is new each time. It runs once without a fault, which counts the
calls about files in that folder, and then once for each kind of fault at each of these calls. A test that needs
steps before or after the fault uses `injected` itself.

Calls are those of `os`; what is written through `open` or `pathlib` goes there, too, by the file layer that Python has
in Python (`_pyio`). Other processes and libraries that open files without Python are not seen.
"""

from __future__ import annotations

import _pyio
import builtins
import errno
import io
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from unittest.mock import patch

#: What can happen at a call. "short": a write writes half and says so. "full": a write writes half, and from there on
#: the disk has no room. The others fail, once, with that error.
KINDS = ("short", "full", "ENOSPC", "EIO", "EACCES")

#: Functions of `os` that are counted: by a path, by two paths, and by the number of an open file.
BY_PATH, BY_PATHS = ("open", "mkdir", "truncate"), ("replace", "rename", "link")
BY_NUMBER = ("write", "read", "fsync", "ftruncate", "sendfile")
#: Of them, those that take room.
GROWING = ("write", "sendfile", "mkdir")


@dataclass
class Calls:
    """The calls that were made, and the fault among them.

    Attributes
    ----------
    fault : str or None
        A name of `KINDS`.
    at : int
        The call that fails, from 0.
    names : list of str
        The names of the calls so far.
    is_full : bool
        Whether the disk has no room at present.
    """

    folder: Path
    fault: str | None = None
    at: int = 0
    names: list[str] = field(default_factory=list)
    is_full: bool = False
    _files: set[tuple[int, int]] = field(default_factory=set)

    def _is_inside(self, place: Any) -> bool:
        if not isinstance(place, (str, os.PathLike)):
            return False
        return Path(os.path.abspath(place)).is_relative_to(self.folder)

    def _is_due(self, name: str) -> bool:
        """Count a call, and whether the fault is at it."""
        self.names.append(name)
        if self.is_full and name in GROWING:
            raise _error("ENOSPC")
        if self.fault is None or len(self.names) - 1 != self.at:
            return False
        if self.fault not in ("short", "full"):
            raise _error(self.fault)
        self.is_full = self.fault == "full"
        return True

    def by_path(self, name: str, real: Callable[..., Any]) -> Callable[..., Any]:
        """A function that is given a path."""

        def called(place: Any, *rest: Any, **named: Any) -> Any:
            if not self._is_inside(place):
                return real(place, *rest, **named)
            self._is_due(name)
            result = real(place, *rest, **named)
            if name == "open":
                self._files.add(_identity(result))
            return result

        return called

    def by_paths(self, name: str, real: Callable[..., Any]) -> Callable[..., Any]:
        """A function that is given two paths."""

        def called(source: Any, to: Any, *rest: Any, **named: Any) -> Any:
            if self._is_inside(to):
                self._is_due(name)
            return real(source, to, *rest, **named)

        return called

    def by_number(self, name: str, real: Callable[..., Any]) -> Callable[..., Any]:
        """A function that is given the number of an open file."""

        def called(number: int, *rest: Any, **named: Any) -> Any:
            if _identity(number) not in self._files or not self._is_due(name):
                return real(number, *rest, **named)
            if name != "write":
                return real(number, *rest, **named)
            data = bytes(rest[0])
            return real(number, data[: (len(data) + 1) // 2])

        return called


def _identity(number: int) -> tuple[int, int]:
    status = os.fstat(number)
    return status.st_dev, status.st_ino


def _error(name: str) -> OSError:
    number = getattr(errno, name)
    return OSError(number, os.strerror(number))


@contextmanager
def injected(folder: Path, fault: str | None = None, at: int = 0) -> Iterator[Calls]:
    """Inside, calls about files in the folder are counted, and the fault is at one of them.

    Parameters
    ----------
    folder
        Where; files that are open before are not seen.
    fault
        A name of `KINDS`; None counts only.
    at
        The number of the call, from 0.
    """
    calls = Calls(Path(os.path.abspath(folder)), fault, at)
    wrapped = dict.fromkeys(BY_PATH, calls.by_path)
    wrapped |= dict.fromkeys(BY_PATHS, calls.by_paths) | dict.fromkeys(BY_NUMBER, calls.by_number)
    seen = {name: wrap(name, getattr(os, name)) for name, wrap in wrapped.items() if hasattr(os, name)}
    with patch.multiple(os, **seen), patch.object(io, "open", _pyio.open):
        with patch.object(builtins, "open", _pyio.open):
            yield calls


@dataclass(frozen=True)
class Trial:
    """One attempt with a fault.

    Attributes
    ----------
    fault : str
        Its kind.
    at : int
        The number of the call that it was at.
    call : str
        The name of that call.
    folder : Path
        What was stored.
    error : Exception or None
        What the attempt raised.
    """

    fault: str
    at: int
    call: str
    folder: Path
    error: Exception | None = None


def trials(
    place: Path,
    attempt: Callable[[Path], object],
    prepare: Callable[[Path], object] = lambda folder: None,
    stride: int = 1,
) -> Iterator[Trial]:
    """Each kind of fault at each call of an attempt.

    Parameters
    ----------
    place
        A folder for the folders of the attempts.
    attempt
        What is tried, in a folder of its own.
    prepare
        What is done to that folder before, without faults.
    stride
        The distance between trials that are made; the last is made always.
    """
    usual = _folder(place / "usual", prepare)
    with injected(usual) as counted:
        attempt(usual)
    assert counted.names, "the attempt makes no call about a file in its folder"
    every = [
        (fault, at, call)
        for fault in KINDS
        for at, call in enumerate(counted.names)
        if fault != "short" or call == "write"
    ]
    for number, (fault, at, call) in enumerate(every, 1):
        if number % stride and number < len(every):
            continue
        folder, error = _folder(place / f"{fault}-{at}", prepare), None
        with injected(folder, fault, at):
            try:
                attempt(folder)
            except Exception as found:
                error = found
        yield Trial(fault, at, call, folder, error)


def _folder(place: Path, prepare: Callable[[Path], object]) -> Path:
    place.mkdir()
    prepare(place)
    return place
