"""The time of a command by its parts, for its last line."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


class Clock:
    """Wall-clock seconds of each part of a command; for the command of a process the first part is its start.

    >>> clock = Clock()
    >>> with clock.part("search"):
    ...     pass
    >>> list(clock.parts)
    ['search']
    """

    #: Whether this process runs a single command.
    of_process = False

    def __init__(self) -> None:
        self.parts: dict[str, float] = {"start": since_start()} if self.of_process else {}

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """Add the time inside the context to the part of this name."""
        began = time.perf_counter()
        try:
            yield
        finally:
            self.parts[name] = self.parts.get(name, 0.0) + time.perf_counter() - began

    def __str__(self) -> str:
        parts = ", ".join(f"{name} {seconds:.2f}" for name, seconds in self.parts.items())
        return f"{sum(self.parts.values()):.2f} s: {parts}"


def since_start() -> float:
    """Return the seconds since this process began, or its processor time where the system does not tell its start."""
    with suppress(OSError, ValueError, IndexError, AttributeError):
        # Field 22 of Linux's stat: the start in hundredths of a second after boot (proc_pid_stat(5), USER_HZ).
        fields = Path("/proc/self/stat").read_text().rpartition(")")[2].split()
        return time.clock_gettime(time.CLOCK_BOOTTIME) - int(fields[19]) / 100.0
    return time.process_time()
