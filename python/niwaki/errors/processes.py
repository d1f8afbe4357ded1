"""Worker processes, each ended together with all processes that it has started.

On Unix a worker leads a session, and so a group of processes; processes that it starts belong to the group unless they
leave it. Windows has no such groups: there the system's `taskkill` ends the tree below a worker that still runs.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress


def lead() -> None:
    """Make this process the leader of a group."""
    if sys.platform != "win32":
        # The system refuses a process that already leads a group.
        with suppress(PermissionError):
            os.setsid()


def end_group(leader: int) -> None:
    """End all processes of a group, with the process that leads the group.

    Parameters
    ----------
    leader
        The leader's process number; this process can be the leader, and then ends, too.
    """
    if sys.platform == "win32":
        words = ["taskkill", "/F", "/T", "/PID", str(leader)]
        subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    else:
        # The group has no processes left, or its number now belongs to another user's processes.
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(leader, signal.SIGKILL)
