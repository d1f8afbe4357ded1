"""A check that there is enough memory for a mesh, before it is read."""

from __future__ import annotations

from niwaki.errors import InputError
from niwaki.errors.memory import free_memory

#: Memory that a mesh takes while it is checked and filled, and while its file is read: measured on closed meshes of a
#: million and ten million triangles, the worst of the formats.
BYTES_PER_TRIANGLE = 200
BYTES_PER_BYTE = 20


def check_memory(name: str, size: str, demand: int) -> None:
    """Refuse a mesh that would not fit while it is read, checked and filled.

    Parameters
    ----------
    name
        The mesh, in the message.
    size
        Its size, in the message.
    demand
        Bytes of memory for it.
    """
    free = free_memory()
    if demand > free:
        raise InputError(
            "mesh-too-large",
            name=name,
            what=size,
            needed=f"{demand / 1e9:.1f} GB",
            free=f"{free / 1e9:.1f} GB",
        )
