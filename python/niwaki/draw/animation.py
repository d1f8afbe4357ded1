"""Moving pictures: a scene growing part by part, or any sequence of its states, as GIF or animated PNG.

Camera, floor and colours are those of the whole for every frame, so that only new parts change the picture. GIF has 256
colours: all frames share one palette, and a fixed pattern of dots (Bayer 1973) hides its steps without flickering.
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

#: The last frame stays for this long, seconds.
HOLD = 1.5

#: Bayer's 4 x 4 pattern, from -0.5 to 0.5, and the height of its dots in steps of 8-bit colour.
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
    """Write a scene growing, part by part.

    Parameters
    ----------
    scene
        The whole.
    path
        Ends in .gif or .apng.
    target
        Drawn as a ghost in every frame, when given.
    parts
        The scene's parts in the order of appearing; that of their addresses when left out.
    frames
        Most frames; several parts appear in one where there are more parts.
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
    """Write a sequence of scenes as one moving picture, such as the states of a chain.

    Parameters
    ----------
    states
        The scenes, first to last; some may be empty.
    path
        Ends in .gif or .apng.
    target
        Drawn as a ghost in every frame, when given.
    seconds
        From the first frame to the last, which then stays for `HOLD` seconds more.
    size
        Width and height in pixels.
    samples
        Rays for each pixel.
    like
        A scene whose framing, floor and palette every frame takes; all states together when left out.
    settings
        As for `niwaki.draw.picture.picture`, except `backdrop="clear"` for GIF, which has no half transparency.

    Returns
    -------
    pathlib.Path
        The file, written completely or not at all.
    """
    place = Path(path)
    suffix = place.suffix.lower()
    if suffix not in FORMATS:
        found = place.suffix or "no suffix"
        raise FileError("file-format", place, suffix=found, done="animated", formats=", ".join(FORMATS))
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
    drawn = [picture(state, target, size=size, samples=samples, like=whole, **settings) for state in states]
    # Both formats count time in hundredths of a second or coarser; browsers slow down what is faster than 0.02 s.
    step = max(20, 10 * round(100.0 * seconds / len(drawn)))
    times = [step] * (len(drawn) - 1) + [step + round(1000 * HOLD)]
    return write_whole(place, _gif(drawn, times) if suffix == ".gif" else _apng(drawn, times))


def _gif(images: Sequence[Image.Image], times: list[int]) -> bytes:
    """All frames in one palette of 256 colours."""
    solid = [_dotted(image) for image in images]
    palette = _palette(solid).quantize(256, Image.Quantize.MEDIANCUT)
    plain = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in solid]
    return _saved(plain, times, "GIF", optimize=False, disposal=1)


def _palette(images: Sequence[Image.Image]) -> Image.Image:
    """The colours of the first, middle and last image, each as often as the square root of its count.

    Otherwise a wide backdrop would use the whole palette, and the colour of a small part would be lost.
    """
    shown = [images[k] for k in sorted({0, len(images) // 2, len(images) - 1})]
    pixels = np.concatenate([np.asarray(image).reshape(-1, 3) for image in shown])
    cells, place, counts = np.unique(pixels >> 3, axis=0, return_inverse=True, return_counts=True)
    sums = np.zeros((len(cells), 3))
    np.add.at(sums, place.reshape(-1), pixels)
    means = np.rint(sums / counts[:, None]).astype(np.uint8)
    return Image.fromarray(np.repeat(means, np.ceil(np.sqrt(counts)).astype(np.int64), axis=0)[None], "RGB")


def _apng(images: Sequence[Image.Image], times: list[int]) -> bytes:
    return _saved(images, times, "PNG")


def _saved(images: Sequence[Image.Image], times: list[int], kind: str, **options: Any) -> bytes:
    out = io.BytesIO()
    first, *others = images
    first.save(out, kind, save_all=True, append_images=others, duration=times, loop=0, **options)
    return out.getvalue()


def _dotted(image: Image.Image) -> Image.Image:
    """The image with the fixed pattern of dots added, so that 256 colours show no bands."""
    pixels: NDArray[np.float64] = np.asarray(image.convert("RGB"), dtype=np.float64)
    height, width, _ = pixels.shape
    dots = np.tile(PATTERN, (-(-height // 4), -(-width // 4)))[:height, :width, None] * DOTS
    return Image.fromarray(np.clip(np.rint(pixels + dots), 0, 255).astype(np.uint8), "RGB")


def _together(states: Sequence[Assembly]) -> Assembly:
    """One scene with the parts of all states, to frame by; a part that stays the same is taken once."""
    found: dict[tuple[str, int], Part] = {}
    for state in states:
        for part in state:
            found.setdefault((part.address, _shapes(part)), part)
    return Assembly(found.values())


def _shapes(part: Part) -> int:
    """A number that distinguishes a part's shapes from others at its address."""
    return hash(tuple(shape.vertices().tobytes() for shape in part.shapes))
