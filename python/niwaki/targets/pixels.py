"""The pixels of image files: PNG, JPEG, WebP, BMP, GIF and TIFF; of several images in a file, the first.

Only these formats are opened: some others that Pillow knows start other programs. The size is read before the pixels.
TIFF files are read in a process of their own, because their reader takes its sizes from the file.
"""

from __future__ import annotations

import io
import re
import warnings
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pil
from PIL import UnidentifiedImageError

from niwaki.errors import FileError
from niwaki.inputs import bytes_of, library, limit, read_apart
from niwaki.inputs.limits import beyond

#: Pillow's names of what is read.
KINDS = ("PNG", "JPEG", "WEBP", "BMP", "GIF", "TIFF")

# What ends a piece of a JPEG and begins a scan.
_SCAN = re.compile(rb"\xff\xda")


def load(path: str | PathLike[str]) -> NDArray[Any]:
    """The channels of an image's file: (rows, columns) or (rows, columns, channels), as `channels` gives them.

    Raises
    ------
    FileError
        The file is missing, larger than is read, has too many pixels, or is no image.
    """
    return parsed(bytes_of(path, "image"), path)


def parsed(data: bytes, place: str | PathLike[str] | None = None) -> NDArray[Any]:
    """The channels of the bytes of an image's file."""
    if data[:4] in (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"):
        memory = limit("memory") + 32 * limit("pixels") + len(data)
        return read_apart(_apart, data, place, "an image", memory)["channels"]
    return _decoded(data, place)


def _apart(data: bytes) -> dict[str, NDArray[Any]]:
    return {"channels": _decoded(data, None)}


def _decoded(data: bytes, place: str | PathLike[str] | None) -> NDArray[Any]:
    _check_webp(data, place)
    if data[:2] == b"\xff\xd8" and len(_SCAN.findall(data)) > limit("scans"):
        raise beyond("scans", f"it has {len(_SCAN.findall(data)):,} scans", place)
    with library(place, "an image"), warnings.catch_warnings():
        # Pillow warns of large images; our own limit is lower.
        warnings.simplefilter("ignore")
        try:
            opened = Pil.open(io.BytesIO(data), formats=KINDS)
        except Pil.DecompressionBombError:
            raise beyond("pixels", "it has more than 100 million pixels", place) from None
        except UnidentifiedImageError:
            reason = f"it is none of {', '.join(KINDS)}"
            raise FileError("file-unreadable", place, suffix="an image", reason=reason) from None
        with opened:
            columns, rows = opened.size
            _check_size(columns, rows, place)
            return channels(opened)


def channels(image: Pil.Image) -> NDArray[Any]:
    """Truth values, or numbers in 0 to 255: red first, alpha last where there is one."""
    alpha = "A" in image.getbands() or "transparency" in image.info
    if image.mode == "1":
        return np.asarray(image, dtype=np.bool_)
    if image.mode.startswith(("I", "F")):
        # Sixteen bits and more: scaled by the brightest, since only zero and not zero matter for what is on.
        values = np.asarray(image, dtype=np.float64)
        if not np.isfinite(values).all():
            raise ValueError("a pixel is not a finite number")
        return values * (255.0 / max(float(values.max()), 1.0))
    return np.asarray(image.convert("RGBA" if alpha else "RGB"))


def _check_size(columns: int, rows: int, place: str | PathLike[str] | None) -> None:
    if columns * rows > limit("pixels"):
        raise beyond("pixels", f"it has {columns:,} x {rows:,} pixels", place)


def _check_webp(data: bytes, place: str | PathLike[str] | None) -> None:
    """Look at the size of a WebP, whose reader takes memory for all pixels as soon as it is opened."""
    if data[:4] != b"RIFF" or data[8:12] != b"WEBP" or len(data) < 30:
        return
    kind = data[12:16]
    if kind == b"VP8X":
        columns, rows = (int.from_bytes(data[at : at + 3], "little") + 1 for at in (24, 27))
    elif kind == b"VP8L":
        bits = int.from_bytes(data[21:25], "little")
        columns, rows = (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    else:
        columns, rows = (int.from_bytes(data[at : at + 2], "little") & 0x3FFF for at in (26, 28))
    _check_size(columns, rows, place)
