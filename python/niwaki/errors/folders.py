"""A folder of results belongs to one run at a time.

A run holds the folder from its start to its last file. Another one that wants it meanwhile gets a message at once, and
not after its search. The system holds the lock and frees it when the process ends, whatever ends it: no file is left
that a person would have to remove.

Which files belong to a run is in its `run.json` (`niwaki.shell.run_files`).
"""

from __future__ import annotations

import errno
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from niwaki.errors.files import PART, FileError, unwritable

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

#: Parts of files older than this were left by a process that was killed; seconds.
LEFT_OVER = 3600.0

#: What a system answers when somebody else has the lock.
_TAKEN = (errno.EACCES, errno.EAGAIN, errno.EWOULDBLOCK, errno.EDEADLK)


@contextmanager
def held_folder(folder: Path) -> Iterator[Path]:
    """The folder, made where it is missing, for this run alone.

    Raises
    ------
    FileError
        `folder-in-use`: another run writes there; `file-unwritable`: it cannot be made.
    """
    try:
        found = folder.exists()
        folder.mkdir(parents=True, exist_ok=True)
        number = _opened(folder)
    except (OSError, ValueError) as error:
        raise unwritable(folder, error) from error
    try:
        _lock(number, folder)
        _remove_left_over(folder)
        try:
            yield folder
        finally:
            if not found:
                # It stays only with something in it.
                with suppress(OSError):
                    folder.rmdir()
            _unlock(number)
    finally:
        os.close(number)


def _opened(folder: Path) -> int:
    """What is locked: the folder itself; on Windows, which cannot lock a folder, a file in it."""
    if sys.platform == "win32":
        return os.open(folder / ".niwaki.lock", os.O_RDWR | os.O_CREAT | os.O_TEMPORARY)
    return os.open(folder, os.O_RDONLY)


def _lock(number: int, folder: Path) -> None:
    try:
        if sys.platform == "win32":
            msvcrt.locking(number, msvcrt.LK_NBLCK, 1)
        else:
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        if error.errno in _TAKEN:
            raise FileError("folder-in-use", folder) from None
        # A file system without locks, such as some network disks: files are still whole, one by one.


def _unlock(number: int) -> None:
    """Free it also for children of a fork, which hold the same lock."""
    with suppress(OSError):
        if sys.platform == "win32":
            msvcrt.locking(number, msvcrt.LK_UNLCK, 1)
        else:
            fcntl.flock(number, fcntl.LOCK_UN)


def _remove_left_over(folder: Path) -> None:
    oldest = time.time() - LEFT_OVER
    for place in folder.glob(f"{PART[0]}*{PART[1]}"):
        with suppress(OSError):
            if place.stat().st_mtime < oldest:
                place.unlink()
