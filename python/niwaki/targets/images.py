"""Images to match: masks of the pixels that should be on, and their weights.

A pixel of a silhouette is on when its red is at least half of the image's brightest: the noise of a JPEG is off, and so
is a border that is less than half covered. In an image with transparent pixels, a pixel is on when it is at least half
as opaque as the most opaque pixel, and has some red. A drawing is ink on paper instead: all pixels but white are ink.
Images are upright, as their files say, and never flipped.
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

#: Suffixes of image files; the content decides the format.
FORMATS = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".gif", ".tif", ".tiff")

#: The lowest grey of paper: scans and photographs of white are not quite white.
PAPER = 250

#: Pixels along a side of a block of lossy compression; the mean of a block survives.
BLOCK = 8


def silhouette(image: Image) -> NDArray[np.bool_]:
    """Return the mask of the pixels that should be on, (rows, columns).

    Raises
    ------
    FileError
        The file is missing or cannot be read as an image.
    InputError
        `bad-image` for an array of another shape; `image-one-color` when all pixels are alike.
    """
    values = _pixels(image).channels
    on = values if values.dtype == np.bool_ else _on(values)
    lit = int(on.sum())
    if lit in (0, on.size):
        raise InputError(
            "image-one-color", name=name_of(image), size=_size(on), state="off" if lit == 0 else "on"
        )
    return np.ascontiguousarray(on)


def ink(image: Image, pixels: int | None = None) -> NDArray[np.uint8]:
    """Read a drawing: greys, (rows, columns) uint8, 255 where there is no ink.

    Transparent pixels are paper, and so are greys from `PAPER` on. In an array of booleans, True is ink. Lossy
    compression leaves ripples around ink. So in a JPEG or a WebP, greys nearer to the lightest than to the darkest are
    paper, unless the image is made `BLOCK` times smaller, which levels the ripples.

    Parameters
    ----------
    image
        A file, a Pillow image or an array.
    pixels
        Pixels of the longer side: a larger image is made smaller. None keeps its size.

    Raises
    ------
    FileError
        The file is missing or cannot be read as an image.
    InputError
        `bad-image` for an array of another shape; `drawing-one-color` when there is no ink, or no paper.
    """
    source = _pixels(image)
    values, paper = source.channels, float(PAPER)
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
    if source.is_lossy and longer < BLOCK * max(page.size):
        paper = min(paper, (float(greys.min()) + float(greys.max())) / 2.0)
    greys[greys >= paper] = 255
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
    values = _pixels(image).channels
    if values.shape[:2] != like.shape[:2]:
        raise InputError("weight-size", name=name_of(image), found=_size(values), expected=_size(like))
    if values.dtype == np.bool_:
        return np.where(values, np.uint8(255), np.uint8(0))
    grey = np.rint(_grey(values)).clip(0, 255)
    return np.ascontiguousarray(grey.astype(np.uint8))


def name_of(image: Image) -> str:
    """Return the name of an image in messages."""
    return str(image) if isinstance(image, (str, PathLike)) else "the image"


def _pixels(image: Image) -> files.Pixels:
    """Return the pixels of a file, a Pillow image or an array, which may be of booleans."""
    if isinstance(image, (str, PathLike)):
        return files.load(image)
    if hasattr(image, "convert") and hasattr(image, "getbands"):
        return _of_pil(image)
    values = np.asarray(image)
    whole = values.ndim == 2 or (values.ndim == 3 and values.shape[2] in (1, 3, 4))
    if not whole or values.size == 0 or values.dtype.kind not in "buif":
        text = f"an array of shape {values.shape} and type {values.dtype}"
        raise InputError("bad-image", found=text)
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        raise InputError("bad-image", found="an array with values that are not finite")
    check("pixels", values.shape[0] * values.shape[1], None)
    return files.Pixels(values)


def _of_pil(image: Any) -> files.Pixels:
    check("pixels", image.width * image.height, None)
    # An image may still have to be read from its file.
    with library(None, "an image"):
        return files.of_image(image)


def _on(values: NDArray[Any]) -> NDArray[np.bool_]:
    red = values if values.ndim == 2 else values[:, :, 0]
    if values.ndim == 3 and values.shape[2] == 4 and (values[:, :, 3] < 255).any():
        return _upper_half(values[:, :, 3]) & (red > 0)
    return _upper_half(red)


def _upper_half(values: NDArray[Any]) -> NDArray[np.bool_]:
    """Return the mask of the values that are at least half of the largest, and above 0."""
    mask: NDArray[np.bool_] = (values > 0) & (values >= 0.5 * float(values.max()))
    return mask


def _grey(values: NDArray[Any]) -> NDArray[np.float64]:
    """Return the mean of red, green and blue, over black where the image is transparent."""
    numbers = values.astype(np.float64)
    if numbers.ndim == 2:
        return numbers
    grey: NDArray[np.float64] = numbers[:, :, :3].mean(axis=2)
    return grey * numbers[:, :, 3] / 255.0 if numbers.shape[2] == 4 else grey


def _size(values: NDArray[Any]) -> str:
    return f"{values.shape[1]} x {values.shape[0]}"
