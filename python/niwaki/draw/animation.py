"""Moving pictures: a scene that grows part by part, or any sequence of scenes, as GIF or animated PNG.

Every frame has the camera, floor and colours of the whole scene, so that only new parts change the picture. GIF has 256
colours: all frames share a palette, and a fixed pattern of dots (Bayer 1973) hides its steps without flicker.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from niwaki.draw.assembly import Assembly, Part, Volume
from niwaki.draw.limits import LARGEST, check_size
from niwaki.draw.picture import picture
from niwaki.errors import FileError
from niwaki.errors.files import write_whole
from niwaki.errors.settings import count

FORMATS = (".gif", ".apng")

#: Duration of the last frame, seconds.
HOLD = 1.5

#: Bayer's 4 x 4 pattern, from -0.5 to 0.5, and its amplitude in steps of 8-bit colour.
PATTERN = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]]) / 15.0 - 0.5
DOTS = 10.0


def growth(
    scene: Assembly,
    path: str | PathLike[str],
    target: Volume | None = None,
    *,
    parts: Sequence[Part] | None = None,
    frames: int = 48,
    **settings: Any,
) -> Path:
    """Write an animation of a scene that grows part by part.

    Parameters
    ----------
    scene
        The whole scene.
    path
        The file; its name ends in .gif or .apng.
    target
        The target to draw as a ghost in every frame.
    parts
        The scene's parts in the order of their appearance; in the order of their addresses when left out.
    frames
        The largest number of frames; with more parts than frames, several parts appear in a frame.
    settings
        As for `animate`.
    """
    count("frames", frames, most=LARGEST)
    if len(scene) == 0:
        raise FileError("scene-empty", path, verb="animate")
    order = scene.parts if parts is None else tuple(parts)
    shown = min(frames, len(order))
    states = [Assembly(order[: -(-len(order) * (k + 1) // shown)]) for k in range(shown)]
    return animate(states, path, target, like=scene, **settings)


def animate(
    states: Sequence[Assembly],
    path: str | PathLike[str],
    target: Volume | None = None,
    *,
    seconds: float = 4.0,
    size: tuple[int, int] = (480, 360),
    samples: int = 4,
    like: Assembly | None = None,
    **settings: Any,
) -> Path:
    """Write a sequence of scenes as a moving picture, for example the states of a chain.

    Parameters
    ----------
    states
        The scenes, first to last; some may be empty.
    path
        The file; its name ends in .gif or .apng.
    target
        The target to draw as a ghost in every frame.
    seconds
        Time from the first frame to the last, which stays for `HOLD` more seconds.
    size
        Width and height in pixels.
    samples
        The number of rays for each pixel.
    like
        The scene whose framing, floor and palette every frame has; all states together when left out.
    settings
        As for `niwaki.draw.picture.picture`, except `backdrop="clear"` for GIF, which has no partial transparency.

    Returns
    -------
    pathlib.Path
        The file. It is written completely or not at all.
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix not in FORMATS:
        ending = place.suffix or "no suffix"
        raise FileError("file-format", place, suffix=ending, done="animated", formats=", ".join(FORMATS))
    if not 0.0 < seconds <= 3600.0:
        raise FileError("setting", name="seconds", found=seconds, expected="a number above 0, at most 3600")
    if suffix == ".gif" and settings.get("backdrop") == "clear":
        raise FileError(
            "setting", place, name="backdrop", found="clear", expected="a colour, or an .apng file"
        )
    whole = _together(states) if like is None else like
    if len(whole) == 0:
        raise FileError("scene-empty", place, verb="animate")
    check_size(size, len(states))
    pictures = [
        picture(state, target, size=size, samples=samples, like=whole, **settings) for state in states
    ]
    # Both formats count time in hundredths of a second; browsers slow down frames shorter than 0.02 s.
    step = max(20, 10 * round(100.0 * seconds / len(pictures)))
    times = [step] * (len(pictures) - 1) + [step + round(1000 * HOLD)]
    return write_whole(place, _gif(pictures, times) if suffix == ".gif" else _apng(pictures, times))


def _gif(images: Sequence[Image.Image], times: list[int]) -> bytes:
    """Encode all frames with a palette of 256 colours."""
    solid = [_dither(image) for image in images]
    palette = _palette(solid).quantize(256, Image.Quantize.MEDIANCUT)
    plain = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in solid]
    return _encode(plain, times, "GIF", optimize=False, disposal=1)


def _palette(images: Sequence[Image.Image]) -> Image.Image:
    """Sample the colours of the first, middle and last image, each by the square root of its count.

    Otherwise a wide backdrop would use the whole palette, and the colours of small parts would be lost.
    """
    shown = [images[k] for k in sorted({0, len(images) // 2, len(images) - 1})]
    pixels = np.concatenate([np.asarray(image).reshape(-1, 3) for image in shown])
    cells, place, counts = np.unique(pixels >> 3, axis=0, return_inverse=True, return_counts=True)
    sums = np.zeros((len(cells), 3))
    np.add.at(sums, place.reshape(-1), pixels)
    means = np.rint(sums / counts[:, None]).astype(np.uint8)
    return Image.fromarray(np.repeat(means, np.ceil(np.sqrt(counts)).astype(np.int64), axis=0)[None], "RGB")


def _apng(images: Sequence[Image.Image], times: list[int]) -> bytes:
    return _encode(images, times, "PNG")


def _encode(images: Sequence[Image.Image], times: list[int], kind: str, **options: Any) -> bytes:
    out = io.BytesIO()
    first, *rest = images
    first.save(out, kind, save_all=True, append_images=rest, duration=times, loop=0, **options)
    return out.getvalue()


def _dither(image: Image.Image) -> Image.Image:
    """Add the fixed pattern of dots to an image, so that 256 colours show no bands."""
    pixels: NDArray[np.float64] = np.asarray(image.convert("RGB"), dtype=np.float64)
    height, width, _ = pixels.shape
    dots = np.tile(PATTERN, (-(-height // 4), -(-width // 4)))[:height, :width, None] * DOTS
    return Image.fromarray(np.clip(np.rint(pixels + dots), 0, 255).astype(np.uint8), "RGB")


def _together(states: Sequence[Assembly]) -> Assembly:
    """Collect the parts of all states in a scene, for the framing; unchanged parts appear once."""
    parts: dict[tuple[str, int], Part] = {}
    for state in states:
        for part in state:
            parts.setdefault((part.address, _shapes(part)), part)
    return Assembly(parts.values())


def _shapes(part: Part) -> int:
    """Hash a part's shapes, to distinguish them from other shapes at its address."""
    return hash(tuple(shape.vertices().tobytes() for shape in part.shapes))
