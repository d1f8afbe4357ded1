"""Sizes of pictures, held against what there is before any pixel is made."""

from __future__ import annotations

from niwaki.errors.memory import check_room
from niwaki.errors.settings import count

#: Largest width, height, number of samples and of frames.
LARGEST = 16_384

#: Bytes of a pixel of a picture: as it is drawn, as it is kept, and as it is written.
PIXEL = 12


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
