"""Locks on folders of results: a folder belongs to one run at a time.

A run holds its folder from its start to its last file. Another run that needs the folder meanwhile fails at once, not
after its search. The operating system holds the lock and frees it when the process ends for whatever reason, so no
lock file is left behind.

A run's `run.json` lists the files that belong to the run (`niwaki.shell.run_files`).
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

#: Seconds after which the part of a file counts as left over by a killed process.
LEFT_OVER = 3600.0

#: The system's answers when another process has the lock.
_LOCKED = (errno.EACCES, errno.EAGAIN, errno.EWOULDBLOCK, errno.EDEADLK)


@contextmanager
def held_folder(folder: Path) -> Iterator[Path]:
    """Hold a folder for this run alone; a missing folder is created.

    Raises
    ------
    FileError
        `folder-in-use`: another run writes to the folder; `file-unwritable`: the folder cannot be created.
    """
    try:
        existed = folder.exists()
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
            if not existed:
                # A folder that this run created stays only if it has files.
                with suppress(OSError):
                    folder.rmdir()
            _unlock(number)
    finally:
        os.close(number)


def _opened(folder: Path) -> int:
    """Open the folder for the lock; on Windows, which cannot lock a folder, open a file in it."""
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
        if error.errno in _LOCKED:
            raise FileError("folder-in-use", folder) from None
        # The file system has no locks, as some network disks: each file is still written whole.


def _unlock(number: int) -> None:
    """Free the lock, also for children of a fork, which hold the same lock."""
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
