"""Confinement of a worker that runs models of a program: on Linux it writes below some folders alone, by Landlock.

Reading and running stay as they are. The rules hold for this thread, and for all threads and processes that it starts
later; nothing takes them back. See `landlock(7)`; the numbers are those of `linux/landlock.h`.
"""

from __future__ import annotations

import ctypes
import os
import struct
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

#: Numbers of the system's calls, the same on all processors.
CREATE, ADD, RESTRICT = 444, 445, 446
#: The flag that asks for the version, the type of a rule about a folder, and the option of `prctl`.
VERSION, BENEATH, NO_NEW_PRIVILEGES = 1, 1, 38
#: Rights to write, to remove and to make files; later versions have those to move and to shorten files, too.
WRITES = 1 << 1 | sum(1 << bit for bit in range(4, 13))
MOVES, SHORTENS = 1 << 13, 1 << 14


def version() -> int:
    """Return the version of Landlock; 0 where the system has none."""
    if not sys.platform.startswith("linux"):
        return 0
    return max(0, int(_system().syscall(CREATE, None, ctypes.c_size_t(0), VERSION)))


def confine(folders: Iterable[Path]) -> bool:
    """Let this process write below these folders, the folder for temporary files and `/dev` alone.

    Returns
    -------
    bool
        Whether the rules hold; without Landlock nothing changes.
    """
    known = version()
    if known == 0:
        return False
    rights = WRITES | (MOVES if known >= 2 else 0) | (SHORTENS if known >= 3 else 0)
    system = _system()
    rules = system.syscall(CREATE, struct.pack("=Q", rights), ctypes.c_size_t(8), 0)
    if rules < 0:
        return False
    try:
        for folder in (*folders, Path(tempfile.gettempdir()), Path("/dev")):
            place = os.open(folder, os.O_PATH | os.O_CLOEXEC)
            try:
                if system.syscall(ADD, rules, BENEATH, struct.pack("=Qi", rights, place), 0) < 0:
                    return False
            finally:
                os.close(place)
        if system.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0) < 0:
            return False
        return int(system.syscall(RESTRICT, rules, 0)) == 0
    finally:
        os.close(rules)


def _system() -> ctypes.CDLL:
    return ctypes.CDLL(None, use_errno=True)
