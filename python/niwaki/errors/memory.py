"""Memory: how much a program can still get, and the refusal of what needs more, before any of it is taken."""

from __future__ import annotations

import os
from pathlib import Path

from niwaki.errors.kinds import InputError

#: Where Linux says what a group of processes may use, and what it uses; its second and its first version.
_GROUPS = (
    ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
    ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"),
)

#: A search stops when less is left: the system would end the process soon, and its results with it.
LEAST = 256 * 2**20

#: More than any machine has: the answer of a system that does not say.
UNKNOWN = 1 << 62


def check_room(name: str, count: int, each: int, what: str, beside: int = 0) -> None:
    """Refuse a count that needs more memory than there is.

    Parameters
    ----------
    name
        The setting, as the person wrote it.
    count
        How many are asked for.
    each
        The least that one takes, bytes.
    what
        One of them, in words.
    beside
        Bytes that are needed for other things.

    Raises
    ------
    InputError
        The numbers: asked for, one, together, free, and how many fit.
    """
    free = max(0, free_memory() - beside)
    if count * each > free:
        raise InputError(
            "no-room",
            name=name,
            asked=f"{count:,}",
            what=what,
            each=size(each),
            needed=size(count * each),
            free=size(free),
            fit=f"{free // each:,}",
        )


def check_left() -> None:
    """Refuse to go on where nearly no memory is left. The engine calls it every 50 milliseconds while it works.

    Raises
    ------
    InputError
        How much is free, and below what a search stops.
    """
    free = free_memory()
    if free < LEAST:
        raise InputError("memory-full", free=size(free), least=size(LEAST))


def size(count: int) -> str:
    """A number of bytes, readable."""
    for unit, factor in (("GB", 10**9), ("MB", 10**6), ("kB", 10**3)):
        if count >= factor:
            return f"{count // factor:,} {unit}" if count >= 100 * factor else f"{count / factor:.1f} {unit}"
    return f"{count} bytes"


def free_memory() -> int:
    """Bytes that this process can still get: of the machine, of its group of processes, and by its own limit."""
    return max(0, min(_of_machine(), *(_of_group(*files) for files in _GROUPS), limit_of_process()))


def _of_machine() -> int:
    try:
        for line in Path("/proc/meminfo").read_text("ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) * 1024
    except (OSError, ValueError):
        pass
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return UNKNOWN


def _of_group(limit: str, used: str) -> int:
    """What a container may still use. The use counts pages of files too, which the system gives up when it must."""
    try:
        left = int(Path(limit).read_text("ascii")) - int(Path(used).read_text("ascii"))
        for line in Path(used).with_name("memory.stat").read_text("ascii").splitlines():
            name, _, pages = line.partition(" ")
            if name == "inactive_file":
                left += int(pages)
    except (OSError, ValueError):
        return UNKNOWN
    return left


def limit_of_process() -> int:
    """What `ulimit -v` leaves."""
    try:
        import resource
    except ImportError:
        return UNKNOWN
    most = resource.getrlimit(resource.RLIMIT_AS)[0]
    if most == resource.RLIM_INFINITY:
        return UNKNOWN
    try:
        pages = int(Path("/proc/self/statm").read_text("ascii").split()[0])
        return most - pages * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError):
        return most
