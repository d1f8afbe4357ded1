"""Whether there is enough memory for a mesh, before it is read."""

from __future__ import annotations

from niwaki.errors import InputError
from niwaki.errors.memory import free_memory

#: Memory that a mesh takes while it is checked and filled, and while its file is read: measured on closed meshes of a
#: million and ten million triangles, the worst of the formats.
BYTES_PER_TRIANGLE = 200
BYTES_PER_BYTE = 20


def check_memory(name: str, what: str, needed: int) -> None:
    """Refuse a mesh that would not fit while it is read, checked and filled."""
    free = free_memory()
    if needed > free:
        raise InputError(
            "mesh-too-large",
            name=name,
            what=what,
            needed=f"{needed / 1e9:.1f} GB",
            free=f"{free / 1e9:.1f} GB",
        )
