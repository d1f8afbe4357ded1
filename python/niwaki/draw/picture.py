"""A scene as a picture, its target as a ghost of tinted glass around it.

Drawn by the engine's own ray caster: a soft sun, sky light, a floor that catches the shadow. The same scene
gives the same pixels on any number of threads. A scene of flat shapes is a drawing instead: see `flat`.
"""

from __future__ import annotations

import io
from math import isfinite
from os import PathLike
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from niwaki import _engine
from niwaki.draw.assembly import Assembly, Volume
from niwaki.draw.flat.drawing import Window, drawing
from niwaki.draw.flat.marks import is_flat
from niwaki.draw.limits import LARGEST, check_rays, check_size
from niwaki.draw.palette import paints
from niwaki.errors import FileError
from niwaki.errors.files import check_place, write_whole
from niwaki.errors.settings import count, is_number

Backdrop = Literal["studio", "white", "slate", "clear"]
Rgb = tuple[float, float, float]
Camera = tuple[Rgb, Rgb, Rgb, float]

#: Upper and lower colour of each backdrop, sRGB; None is transparent.
BACKDROPS: dict[str, tuple[Rgb, Rgb] | None] = {
    "studio": ((0.965, 0.96, 0.95), (0.885, 0.878, 0.865)),
    "white": ((1.0, 1.0, 1.0), (1.0, 1.0, 1.0)),
    "slate": ((0.27, 0.29, 0.32), (0.19, 0.205, 0.23)),
    "clear": None,
}

IMAGE_FORMATS = (".png", ".jpg", ".jpeg", ".webp")


def picture(
    scene: Assembly,
    target: Volume | None = None,
    *,
    size: tuple[int, int] = (960, 720),
    samples: int = 16,
    azimuth: float = 38.0,
    elevation: float = 24.0,
    fov: float = 26.0,
    margin: float = 0.08,
    camera: Camera | None = None,
    backdrop: Backdrop = "studio",
    lift: float = 0.0,
    frame: Assembly | None = None,
    like: Assembly | None = None,
    style: str = "ink",
    window: Window | None = None,
    under: NDArray[np.bool_] | None = None,
) -> Image.Image:
    """Draws a scene.

    Parameters
    ----------
    scene
        What to draw.
    target
        Drawn as a ghost, when given; it counts for the framing.
    size
        Width and height in pixels.
    samples
        Rays for each pixel where the picture changes, a quarter elsewhere; 4 for a draft, 16 for a page, 64 for print.
    azimuth, elevation
        The direction of the camera, degrees: 0, 0 looks from +z; azimuth 90 from +x; elevation 90 from above.
    fov
        Vertical field of view, degrees.
    margin
        Empty border as a share of the picture.
    camera
        Eye, target, up and vertical field of view; replaces the five above.
    backdrop
        "studio", "white", "slate" or "clear" (transparent, with the shadow in the alpha channel).
    lift
        How far the scene floats above the floor, as a share of its height.
    frame
        Another scene whose framing to take, so that pictures of several can be compared.
    like
        Another scene whose framing, floor and palette to take, so that pictures of its states agree; this one may
        then be empty.
    style, window, under
        Of a scene of flat shapes, which is drawn as `niwaki.draw.flat.drawing.drawing` does unless a `camera` is given.

    Returns
    -------
    PIL.Image.Image
        RGBA.
    """
    if backdrop not in get_args(Backdrop):
        raise FileError("setting", name="backdrop", found=backdrop, expected=", ".join(get_args(Backdrop)))
    if len(scene) == 0 and target is None and like is None:
        raise FileError("scene-empty", verb="draw")
    width, height = size
    check_size(size)
    count("samples", samples, most=LARGEST)
    for name, value in (
        ("azimuth", azimuth),
        ("elevation", elevation),
        ("fov", fov),
        ("margin", margin),
        ("lift", lift),
    ):
        if not is_number(value) or not isfinite(value):
            raise FileError("setting", name=name, found=value, expected="a finite number")
    frame = like if frame is None else frame
    if camera is None and target is None and is_flat(scene if like is None else like):
        if window is None and frame is not None:
            (x, y, _), (right, high, _) = frame.bounds.tolist()
            pad = 0.5 * margin * max(right - x, high - y)
            window = (x - pad, y - pad), (right + pad, high + pad)
        clear = backdrop == "clear"
        return drawing(
            scene,
            size=size,
            style=style,
            window=window,
            margin=margin / 2,
            under=under,
            clear=clear,
            like=like,
        )
    shown = surfaces(scene, like)
    ghost = None if target is None else _ghost(target)
    check_rays(size, sum(part.triangles for part in (shown, ghost) if part is not None))
    if camera is None:
        camera = _engine.frame_camera(
            shown if frame is None else surfaces(frame),
            None if target is None else target.vertices,
            azimuth=azimuth,
            elevation=elevation,
            fov_y=fov,
            margin=margin,
            aspect=width / height,
        )
    standing = scene if like is None else like
    low, high = standing.bounds if len(standing) else target.bounds  # type: ignore[union-attr]
    pixels = _engine.render(
        shown,
        ghost,
        camera=camera,
        width=width,
        height=height,
        samples=samples,
        backdrop=BACKDROPS[backdrop],
        floor=float(low[1] - lift * (high[1] - low[1])),
    )
    return Image.fromarray(pixels, "RGBA")


def surfaces(scene: Assembly, like: Assembly | None = None) -> _engine.Surfaces:
    """Make the surfaces of all shapes with their paint, as the engine's `render` takes them."""
    return _engine.Surfaces(
        [
            (shape, paint.color, (paint.gloss, paint.metalness, paint.rough, paint.pitch))
            for part, part_paints in zip(scene.parts, paints(scene, like), strict=True)
            for shape, paint in zip(part.shapes, part_paints, strict=True)
        ]
    )


def png(image: Image.Image) -> bytes:
    """Return the image as the bytes of a PNG file."""
    out = io.BytesIO()
    image.save(out, "PNG")
    return out.getvalue()


def save(scene: Assembly, path: str | PathLike[str], target: Volume | None = None, **settings: Any) -> Path:
    """Draws a scene into a file; `settings` are those of `picture`."""
    return save_image(lambda: picture(scene, target, **settings), path)


def save_image(draw: Any, path: str | PathLike[str]) -> Path:
    """Write the image that `draw()` returns, completely or not at all; its name is checked before drawing."""
    place = check_image(path)
    image: Image.Image = draw()
    out = io.BytesIO()
    kind = Image.registered_extensions()[place.suffix.lower()]
    image.convert("RGB" if kind == "JPEG" else "RGBA").save(out, kind)
    return write_whole(place, out.getvalue())


def check_image(path: str | PathLike[str]) -> Path:
    """Refuse a place where no picture can be written: its suffix, or its folder.

    Raises
    ------
    FileError
        The suffix is that of no picture, or there is no such folder.
    """
    place = Path(path)
    if place.suffix.lower() not in IMAGE_FORMATS:
        raise FileError(
            "file-format",
            place,
            suffix=place.suffix or "no suffix",
            done="drawn",
            formats=", ".join(IMAGE_FORMATS),
        )
    return check_place(place)


def preview(scene: Assembly) -> bytes:
    """Return a small picture of a scene as the bytes of a PNG file, for notebooks; one clear pixel of an empty one."""
    return png(picture(scene, size=(800, 600)) if len(scene) else Image.new("RGBA", (1, 1)))


def _ghost(target: Volume) -> _engine.Surfaces:
    """Make the target's surface, with normals that are smooth where it is smooth."""
    shape = _engine.shape("mesh", target.vertices, target.faces)
    return _engine.Surfaces([(shape, (1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 0.0))])
