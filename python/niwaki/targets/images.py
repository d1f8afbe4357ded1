"""Images to match: which pixels should be on, and how much each matters.

A pixel of a silhouette is on when its red is above zero, so that the grey edge of a smoothed shape counts as on; pixels
that are wholly transparent are off. A drawing is ink on paper instead: what is not white is ink. No image is flipped:
the camera, or the reader of the page, should see it as it is.
"""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image as Pil

from niwaki.errors import InputError
from niwaki.inputs import library
from niwaki.inputs.limits import check
from niwaki.targets import pixels as files

if TYPE_CHECKING:
    from PIL.Image import Image as PilImage

    Image = str | PathLike[str] | PilImage | ArrayLike
else:
    Image = Any

#: Names of files with images end in one of these; the content decides what is read.
FORMATS = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".gif", ".tif", ".tiff")

#: Greys from here on are paper: scans and photographs of white are not quite white.
PAPER = 250


def silhouette(image: Image) -> NDArray[np.bool_]:
    """Tell which pixels should be on, (rows, columns).

    Raises
    ------
    FileError
        The file is missing or cannot be read as an image.
    InputError
        `bad-image` for an array of another shape; `image-one-color` when all pixels are alike.
    """
    values = _values(image)
    on = values if values.dtype == np.bool_ else _red(values) > 0
    lit = int(on.sum())
    if lit in (0, on.size):
        raise InputError(
            "image-one-color", name=name_of(image), size=_size(on), state="off" if lit == 0 else "on"
        )
    return np.ascontiguousarray(on)


def ink(image: Image, pixels: int | None = None) -> NDArray[np.uint8]:
    """Read a drawing: greys, (rows, columns) uint8, 255 where there is no ink.

    Transparent pixels are paper, and so are greys from `PAPER` on. Of truth values the true ones are ink.

    Parameters
    ----------
    image
        A file, a Pillow image or an array.
    pixels
        Of the longer side: a larger image is made smaller. As it is when left out.

    Raises
    ------
    FileError
        The file is missing or cannot be read as an image.
    InputError
        `bad-image` for an array of another shape; `drawing-one-color` when there is no ink, or no paper.
    """
    values = _values(image)
    if values.dtype == np.bool_:
        grey = np.where(values, 0.0, 255.0)
    else:
        alpha = values[:, :, 3:] / 255.0 if values.ndim == 3 and values.shape[2] == 4 else 1.0
        colors = values[:, :, :3] if values.ndim == 3 else values[:, :, None]
        grey = (colors * alpha + 255.0 * (1.0 - alpha)).mean(axis=2)
    page = Pil.fromarray(np.rint(grey.clip(0, 255)).astype(np.uint8))
    longer = max(page.size)
    if pixels is not None and longer > pixels:
        columns, rows = (max(1, round(side * pixels / longer)) for side in page.size)
        # Means of areas: other filters ring, and their ripples on the paper would be ink.
        page = page.resize((columns, rows), Pil.Resampling.BOX)
    greys = np.array(page)
    greys[greys >= PAPER] = 255
    filled = int((greys < 255).sum())
    if filled in (0, greys.size):
        raise InputError(
            "drawing-one-color",
            name=name_of(image),
            size=_size(greys),
            state="paper" if filled == 0 else "ink",
        )
    return np.ascontiguousarray(greys)


def weights(image: Image, like: NDArray[Any]) -> NDArray[np.uint8]:
    """Read the greys of a weight image, (rows, columns) uint8, of the same size as the image that it weighs.

    Raises
    ------
    InputError
        `weight-size` when the sizes differ.
    """
    values = _values(image)
    if values.shape[:2] != like.shape[:2]:
        raise InputError("weight-size", name=name_of(image), found=_size(values), expected=_size(like))
    if values.dtype == np.bool_:
        return np.where(values, np.uint8(255), np.uint8(0))
    grey = np.rint(_grey(values)).clip(0, 255)
    return np.ascontiguousarray(grey.astype(np.uint8))


def name_of(image: Image) -> str:
    """What to call an image in a message."""
    return str(image) if isinstance(image, (str, PathLike)) else "the image"


def _values(image: Image) -> NDArray[Any]:
    """Return (rows, columns) bool or numbers in 0 to 255, or (rows, columns, channels) of the latter."""
    if isinstance(image, (str, PathLike)):
        return files.load(image)
    if hasattr(image, "convert") and hasattr(image, "getbands"):
        return _of_pil(image)
    values = np.asarray(image)
    whole = values.ndim == 2 or (values.ndim == 3 and values.shape[2] in (1, 3, 4))
    if not whole or values.size == 0 or values.dtype.kind not in "buif":
        found = f"an array of shape {values.shape} and type {values.dtype}"
        raise InputError("bad-image", found=found)
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        raise InputError("bad-image", found="an array with values that are not finite")
    check("pixels", values.shape[0] * values.shape[1], None)
    return values


def _of_pil(image: Any) -> NDArray[Any]:
    check("pixels", image.width * image.height, None)
    # An image may still have to be read from its file.
    with library(None, "an image"):
        return files.channels(image)


def _red(values: NDArray[Any]) -> NDArray[Any]:
    if values.ndim == 2:
        return values
    red = values[:, :, 0]
    return np.where(values[:, :, 3] > 0, red, 0) if values.shape[2] == 4 else red


def _grey(values: NDArray[Any]) -> NDArray[np.float64]:
    """Mean of red, green and blue, over black where the image is transparent."""
    numbers = values.astype(np.float64)
    if numbers.ndim == 2:
        return numbers
    grey: NDArray[np.float64] = numbers[:, :, :3].mean(axis=2)
    return grey * numbers[:, :, 3] / 255.0 if numbers.shape[2] == 4 else grey


def _size(values: NDArray[Any]) -> str:
    return f"{values.shape[1]} x {values.shape[0]}"
