"""The bytes of a user's file: only of regular files, and up to a limit."""

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
# `O_NONBLOCK`: a pipe or device that replaces the file between the check and the opening must not block.
_FLAGS = os.O_RDONLY | sum(
    getattr(os, name, 0) for name in ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY")
)


def regular(path: str | PathLike[str]) -> Path:
    """Return the path of an existing regular file.

    Raises
    ------
    FileError
        The file does not exist, is a folder, pipe or device, or the system refuses access.
    """
    place = Path(path)
    try:
        _refuse_irregular(os.stat(place), path)
    except (OSError, ValueError) as error:
        raise _unopened(error, path) from None
    return place


def bytes_of(path: str | PathLike[str], kind: str) -> bytes:
    """Return the bytes of a file.

    Parameters
    ----------
    path
        The file.
    kind
        The name of the limit.

    Raises
    ------
    FileError
        `file-missing`, `file-not-regular`, `file-limit`; `file-unreadable`: the system refuses access.
    """
    place, most = regular(path), limit(kind)
    try:
        handle = os.open(place, _FLAGS)
        try:
            status = os.fstat(handle)
            _refuse_irregular(status, path)
            if status.st_size > most:
                raise beyond(kind, f"it has {status.st_size:,} bytes", path)
            # Read up to one byte beyond the limit: some files grow during the reading, or hide their size.
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


def text_of(path: str | PathLike[str], kind: str, expected: str) -> str:
    """Return the text of a file in UTF-8; messages name the `expected` kind of file."""
    try:
        return bytes_of(path, kind).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(
            "file-unreadable", path, suffix=expected, reason=f"it is not text: {error}"
        ) from error


def _refuse_irregular(status: os.stat_result, path: str | PathLike[str]) -> None:
    if not stat.S_ISREG(status.st_mode):
        kind = next((kind for test, kind in _KINDS if test(status.st_mode)), "something else")
        raise FileError("file-not-regular", path, found=kind)


def _unopened(error: OSError | ValueError, path: str | PathLike[str]) -> FileError:
    """Return the error about a file that the system cannot open."""
    missing = isinstance(error, (FileNotFoundError, NotADirectoryError))
    shown = (
        str(path).encode("unicode_escape", "backslashreplace").decode() if "\0" in str(path) else str(path)
    )
    if missing or isinstance(error, ValueError):
        return FileError("file-missing", shown, absolute=Path(shown).absolute(), folder=Path.cwd())
    return FileError("file-unreadable", path, suffix="a file", reason=error.strerror or str(error))
