"""Where the time of a command went, as its last line says it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


class Clock:
    """Seconds of the wall by what was done in them; for the command of a process its start is the first part.

    >>> clock = Clock()
    >>> with clock.part("search"):
    ...     pass
    >>> list(clock.parts)
    ['search']
    """

    #: Whether this process is for one command.
    of_process = False

    def __init__(self) -> None:
        self.parts: dict[str, float] = {"start": since_start()} if self.of_process else {}

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """Inside, time counts for this name."""
        began = time.perf_counter()
        try:
            yield
        finally:
            self.parts[name] = self.parts.get(name, 0.0) + time.perf_counter() - began

    def __str__(self) -> str:
        listed = ", ".join(f"{name} {seconds:.2f}" for name, seconds in self.parts.items())
        return f"{sum(self.parts.values()):.2f} s: {listed}"


def since_start() -> float:
    """Seconds since this process began; its processor time where the system does not say when that was."""
    with suppress(OSError, ValueError, IndexError, AttributeError):
        # Field 22 of Linux's stat: the start in hundredths of a second after boot (proc_pid_stat(5), USER_HZ).
        fields = Path("/proc/self/stat").read_text().rpartition(")")[2].split()
        return time.clock_gettime(time.CLOCK_BOOTTIME) - int(fields[19]) / 100.0
    return time.process_time()
