"""The bytes of a file that a person names: of a regular file only, and not more than a limit."""

from __future__ import annotations

import os
import stat
from os import PathLike
from pathlib import Path

from niwaki.errors import FileError
from niwaki.inputs.limits import beyond, limit

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)
# A pipe or a device must not make us wait, even one that takes the file's place while we look.
_FLAGS = os.O_RDONLY | sum(
    getattr(os, name, 0) for name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY")
)


def regular(path: str | PathLike[str]) -> Path:
    """The path of a regular file that is there.

    Raises
    ------
    FileError
        There is none, or a folder, a pipe, a device; or the system refuses to look.
    """
    place = Path(path)
    try:
        _refuse_irregular(os.stat(place), path)
    except (OSError, ValueError) as error:
        raise _unopened(error, path) from None
    return place


def bytes_of(path: str | PathLike[str], kind: str) -> bytes:
    """The bytes of a file.

    Parameters
    ----------
    path
        The file.
    kind
        The name of its limit.

    Raises
    ------
    FileError
        `file-missing`, `file-not-regular`, `file-limit`; `file-unreadable` where the system refuses.
    """
    place, most = regular(path), limit(kind)
    try:
        handle = os.open(place, _FLAGS)
        try:
            status = os.fstat(handle)
            _refuse_irregular(status, path)
            if status.st_size > most:
                raise beyond(kind, f"it has {status.st_size:,} bytes", path)
            # One byte more than the limit: some files grow while they are read, or hide their size.
            parts, left = [], most + 1
            while left > 0 and (part := os.read(handle, min(left, 1 << 24))):
                parts.append(part)
                left -= len(part)
        finally:
            os.close(handle)
    except (OSError, ValueError) as error:
        raise _unopened(error, path) from None
    if left <= 0:
        raise beyond(kind, f"it has more than {most:,} bytes", path)
    return b"".join(parts)


def text_of(path: str | PathLike[str], kind: str, what: str) -> str:
    """The text of a file in UTF-8; `what` says what it should be, for messages."""
    try:
        return bytes_of(path, kind).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError("file-unreadable", path, suffix=what, reason=f"it is no text: {error}") from error


def _refuse_irregular(status: os.stat_result, path: str | PathLike[str]) -> None:
    if not stat.S_ISREG(status.st_mode):
        found = next((what for test, what in _KINDS if test(status.st_mode)), "something else")
        raise FileError("file-not-regular", path, found=found)


def _unopened(error: OSError | ValueError, path: str | PathLike[str]) -> FileError:
    """What the system said when it was asked for a file."""
    missing = isinstance(error, (FileNotFoundError, NotADirectoryError))
    shown = (
        str(path).encode("unicode_escape", "backslashreplace").decode() if "\0" in str(path) else str(path)
    )
    if missing or isinstance(error, ValueError):
        return FileError("file-missing", shown, absolute=Path(shown).absolute(), folder=Path.cwd())
    return FileError("file-unreadable", path, suffix="a file", reason=error.strerror or str(error))
