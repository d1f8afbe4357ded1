"""Whether there is enough memory for a mesh, before it is read."""

from __future__ import annotations

import os

from niwaki.errors import InputError

#: Memory that a mesh takes while it is checked and filled, and while its file is read: measured on closed meshes of a
#: million and ten million triangles, the worst of the formats.
BYTES_PER_TRIANGLE = 200
BYTES_PER_BYTE = 20


def check_memory(name: str, what: str, needed: int) -> None:
    """Refuse a mesh that would not fit while it is read, checked and filled."""
    free = _free_memory()
    if needed > free:
        raise InputError(
            "mesh-too-large",
            name=name,
            what=what,
            needed=f"{needed / 1e9:.1f} GB",
            free=f"{free / 1e9:.1f} GB",
        )


def _free_memory() -> int:
    """Bytes that a program can still get; without an answer of the system, as many as there can be."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            for line in lines:
                if line.startswith("MemAvailable:"):
                    return int(line.split()[1]) * 1024
    except (OSError, ValueError):
        pass
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return 1 << 62
