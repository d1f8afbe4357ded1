"""Limits of pictures: sizes and memory, checked before drawing."""

from __future__ import annotations

import os

from niwaki.errors.memory import UNKNOWN, check_room, limit_of_process
from niwaki.errors.settings import count, usual_threads

#: Largest width, height, number of samples and of frames.
LARGEST = 16_384

#: Bytes of a pixel of a picture, for drawing, storing and writing.
PIXEL = 12

#: Bytes that the ray caster needs for a pixel that shows a shape, and for a triangle, including Python's objects.
#: Measured by the memory growth of a process with full pictures of 1 and of 4000 shapes, and rounded up.
TRACED, TRIANGLE = 480, 320

#: Bytes of address space that a thread of the engine reserves: its stack, and a segment of the allocator.
THREAD = 36 * 2**20


def check_size(size: tuple[int, int], pictures: int = 1, fine: int = 1) -> None:
    """Check that a size is valid and fits into memory.

    Parameters
    ----------
    size
        Width and height.
    pictures
        The number of pictures that are in memory at the same time.
    fine
        The factor of oversampling: a picture is drawn wider and higher by it, then reduced.
    """
    for name, number in zip(("width", "height"), size, strict=True):
        count(name, number, most=LARGEST)
    pixels = size[0] * size[1]
    check_room("size", pixels * fine**2, PIXEL, "pixel")
    check_room("frames", pictures, pixels * PIXEL, f"picture of {size[0]} x {size[1]}")


def check_rays(size: tuple[int, int], triangles: int) -> None:
    """Check that a ray-cast picture fits into memory; otherwise the engine would end the process.

    Parameters
    ----------
    size
        Width and height in pixels.
    triangles
        Number of triangles of all meshes.
    """
    pixels = size[0] * size[1]
    threads = (usual_threads() or os.cpu_count() or 1) * THREAD if limit_of_process() < UNKNOWN else 0
    check_room("size", pixels, TRACED, "pixel that shows something", beside=threads)
    check_room("triangles", triangles, TRIANGLE, "triangle", beside=threads + pixels * TRACED)
