"""Free memory, and checks that refuse a search before it takes more than that."""

from __future__ import annotations

import os
from pathlib import Path

from niwaki.errors.kinds import InputError

#: Linux's files with the memory limit and the use of a group of processes, of versions 2 and 1.
_GROUPS = (
    ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
    ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"),
)

#: A search stops when fewer bytes are free: the system would soon end the process, and lose its results.
LEAST = 256 * 2**20

#: The answer where the system does not tell the free memory: more bytes than any machine has.
UNKNOWN = 1 << 62


def check_room(name: str, count: int, each: int, unit: str, beside: int = 0) -> None:
    """Refuse a count that needs more memory than is free.

    Parameters
    ----------
    name
        The setting's name, as the user wrote it.
    count
        The requested count.
    each
        The least bytes that one of the count takes.
    unit
        The noun for one of the count, such as "particle".
    beside
        Bytes that other parts of the search need.

    Raises
    ------
    InputError
        The message has the requested count, the bytes of each and of all, the free bytes, and the count that fits.
    """
    free = max(0, free_memory() - beside)
    if count * each > free:
        raise InputError(
            "no-room",
            name=name,
            asked=f"{count:,}",
            what=unit,
            each=size(each),
            needed=size(count * each),
            free=size(free),
            fit=f"{free // each:,}",
        )


def check_left() -> None:
    """Stop a search when almost no memory is free. The engine calls this every 50 milliseconds.

    Raises
    ------
    InputError
        The message has the free bytes, and the least that a search needs.
    """
    free = free_memory()
    if free < LEAST:
        raise InputError("memory-full", free=size(free), least=size(LEAST))


def size(count: int) -> str:
    """Return a number of bytes as text, such as "1.5 GB"."""
    for unit, factor in (("GB", 10**9), ("MB", 10**6), ("kB", 10**3)):
        if count >= factor:
            return f"{count // factor:,} {unit}" if count >= 100 * factor else f"{count / factor:.1f} {unit}"
    return f"{count} bytes"


def free_memory() -> int:
    """Return the bytes that this process can still take from the machine, its group of processes and its own limit."""
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
    """Return the bytes that a container may still use; pages of files count as free, because the system drops them."""
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
    """Return the bytes that `ulimit -v` still allows."""
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
