"""A worker process and all that it has started, ended as one.

On Unix a worker leads a session, and with it a group of processes; whatever it starts is of the group, unless it leaves
it. Windows has no such groups: there `taskkill`, which is a part of it, ends the tree below a worker that still runs.
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
        # A process that leads a group already is refused.
        with suppress(PermissionError):
            os.setsid()


def end_group(leader: int) -> None:
    """End a process that leads a group, where it still runs, and all processes of the group.

    Parameters
    ----------
    leader
        The number of the process; that of this one ends it, too.
    """
    if sys.platform == "win32":
        words = ["taskkill", "/F", "/T", "/PID", str(leader)]
        subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    else:
        # There is none, or what is left of it has become somebody else's.
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(leader, signal.SIGKILL)
