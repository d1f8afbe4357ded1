"""Pixels of image files: PNG, JPEG, WebP, BMP, GIF and TIFF. In a file with several images, only the first is read.

Pixels are upright: turned and mirrored as the file's orientation says (EXIF tag 274, or XMP). Other formats are not
opened, because some that Pillow knows start other programs. The size is read before the pixels. A separate process
reads TIFF files, because their reader takes its sizes from the file.
"""

from __future__ import annotations

import io
import re
import warnings
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import ExifTags, UnidentifiedImageError
from PIL import Image as Pil

from niwaki.errors import FileError
from niwaki.inputs import bytes_of, library, limit, read_apart
from niwaki.inputs.limits import beyond

#: Pillow's names of the formats.
KINDS = ("PNG", "JPEG", "WEBP", "BMP", "GIF", "TIFF")

#: Formats whose compression leaves ripples around edges; WebP seldom keeps every pixel, and does not say so.
LOSSY = ("JPEG", "MPO", "WEBP")

# The marker of a JPEG that begins a scan.
_SCAN = re.compile(rb"\xff\xda")

# The tag of a TIFF that says whether 0 is black.
_PHOTOMETRIC = 262

# Transposes that turn the pixels of an orientation upright (TIFF 6.0, Orientation).
_UPRIGHT = {
    2: Pil.Transpose.FLIP_LEFT_RIGHT,
    3: Pil.Transpose.ROTATE_180,
    4: Pil.Transpose.FLIP_TOP_BOTTOM,
    5: Pil.Transpose.TRANSPOSE,
    6: Pil.Transpose.ROTATE_270,
    7: Pil.Transpose.TRANSVERSE,
    8: Pil.Transpose.ROTATE_90,
}


@dataclass(frozen=True)
class Pixels:
    """The pixels of an image.

    Attributes
    ----------
    channels : (rows, columns) or (rows, columns, channels)
        Numbers in 0 to 255: red first, alpha last where there is one.
    is_lossy : bool
        Whether the image was compressed with a loss.
    """

    channels: NDArray[Any]
    is_lossy: bool = False


def load(path: str | PathLike[str]) -> Pixels:
    """Read the pixels of an image file.

    Raises
    ------
    FileError
        The file is missing, larger than the limit, has too many pixels, or is no image.
    """
    return parsed(bytes_of(path, "image"), path)


def parsed(data: bytes, place: str | PathLike[str] | None = None) -> Pixels:
    """Parse the bytes of an image file."""
    if data[:4] in (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"):
        memory = limit("memory") + 32 * limit("pixels") + len(data)
        arrays = read_apart(_apart, data, place, "an image", memory)
        return Pixels(arrays["channels"], bool(arrays["is_lossy"]))
    return _decoded(data, place)


def _apart(data: bytes) -> dict[str, NDArray[Any]]:
    pixels = _decoded(data, None)
    return {"channels": pixels.channels, "is_lossy": np.array(pixels.is_lossy)}


def _decoded(data: bytes, place: str | PathLike[str] | None) -> Pixels:
    _check_webp(data, place)
    if data[:2] == b"\xff\xd8" and len(_SCAN.findall(data)) > limit("scans"):
        raise beyond("scans", f"it has {len(_SCAN.findall(data)):,} scans", place)
    with library(place, "an image"), warnings.catch_warnings():
        # Pillow warns of large images; our own limit is lower.
        warnings.simplefilter("ignore")
        try:
            image = Pil.open(io.BytesIO(data), formats=KINDS)
        except Pil.DecompressionBombError:
            raise beyond("pixels", "it has more than 100 million pixels", place) from None
        except UnidentifiedImageError:
            reason = f"it is none of {', '.join(KINDS)}"
            raise FileError("file-unreadable", place, suffix="an image", reason=reason) from None
        with image:
            columns, rows = image.size
            _check_size(columns, rows, place)
            return of_image(image)


def of_image(image: Pil.Image) -> Pixels:
    """Return the pixels of a Pillow image."""
    is_lossy = image.format in LOSSY or "jpeg" in str(image.info.get("compression"))
    return Pixels(_channels(_upright(image)), is_lossy)


def _upright(image: Pil.Image) -> Pil.Image:
    # Pillow turns TIFF files itself while it loads them.
    image.load()
    try:
        orientation = image.getexif().get(ExifTags.Base.Orientation)
    except Exception:
        # Metadata of a camera may be damaged in any way; the pixels are good.
        return image
    method = _UPRIGHT.get(orientation) if isinstance(orientation, int) else None
    return image if method is None else image.transpose(method)


def _channels(image: Pil.Image) -> NDArray[Any]:
    clear = image.info.get("transparency")
    if image.mode.startswith(("I", "F")):
        # Sixteen bits and more are scaled by the brightest, because no field says which number is white.
        values = np.asarray(image, dtype=np.float64)
        if not np.isfinite(values).all():
            raise ValueError("a pixel is not a finite number")
        if image.mode.startswith("I;16") and getattr(image, "tag_v2", {}).get(_PHOTOMETRIC) == 0:
            # Pillow leaves a TIFF's sixteen bits as they are where 0 is white.
            values = 65535.0 - values
        grey = values * (255.0 / max(float(values.max()), 1.0))
        if not isinstance(clear, int):
            return grey
        return np.stack([grey, grey, grey, np.where(values == clear, 0.0, 255.0)], axis=2)
    alpha = clear is not None or "A" in image.getbands() or image.mode in ("La", "RGBa")
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
