"""Sizes of pictures, held against what there is before any pixel is made."""

from __future__ import annotations

import os

from niwaki.errors.memory import UNKNOWN, check_room, limit_of_process
from niwaki.errors.settings import count, usual_threads

#: Largest width, height, number of samples and of frames.
LARGEST = 16_384

#: Bytes of a pixel of a picture: as it is drawn, as it is kept, and as it is written.
PIXEL = 12

#: Bytes that the ray caster takes for a pixel that shows something, and for a triangle; with what Python keeps.
#: Measured as the growth of the memory of a process by pictures that are full, of 1 and of 4000 shapes, and rounded up.
TRACED, TRIANGLE = 480, 320

#: Bytes of the address space that a thread of the engine reserves: its stack, and a segment of the allocator.
THREAD = 36 * 2**20


def check_size(size: tuple[int, int], pictures: int = 1, fine: int = 1) -> None:
    """Refuse a size in pixels that is none, or that does not fit.

    Parameters
    ----------
    size
        Width and height.
    pictures
        So many are kept at once.
    fine
        A picture is drawn so many times wider and higher, and then made smaller.
    """
    for name, number in zip(("width", "height"), size, strict=True):
        count(name, number, most=LARGEST)
    pixels = size[0] * size[1]
    check_room("size", pixels * fine**2, PIXEL, "pixel")
    check_room("frames", pictures, pixels * PIXEL, f"picture of {size[0]} x {size[1]}")


def check_rays(size: tuple[int, int], triangles: int) -> None:
    """Refuse a picture by rays that does not fit into memory; the engine would end the process.

    Parameters
    ----------
    size
        Width and height in pixels.
    triangles
        Of all meshes that are drawn.
    """
    pixels = size[0] * size[1]
    threads = (usual_threads() or os.cpu_count() or 1) * THREAD if limit_of_process() < UNKNOWN else 0
    check_room("size", pixels, TRACED, "pixel that shows something", beside=threads)
    check_room("triangles", triangles, TRIANGLE, "triangle", beside=threads + pixels * TRACED)
