"""Pictures of scenes, with the target and the obstacles as ghosts of tinted glass, each in a colour of its own.

The engine's ray caster draws a soft sun, sky light, and a floor with the shadow. Equal scenes give equal pixels on any
number of threads. A scene of flat shapes becomes a drawing: see `flat`.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
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
from niwaki.draw.palette import OBSTACLE, paints
from niwaki.draw.parts import coated
from niwaki.errors import FileError
from niwaki.errors.files import check_place, write_whole
from niwaki.errors.settings import count, is_number

Backdrop = Literal["studio", "white", "slate", "clear"]
Rgb = tuple[float, float, float]
Camera = tuple[Rgb, Rgb, Rgb, float]

#: The backdrop with the obstacles of the dark palette.
DARK = "slate"
#: The upper and lower colour of each backdrop, sRGB; None for a transparent backdrop.
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
    obstacles: Sequence[Volume] = (),
    ground: float | None = None,
) -> Image.Image:
    """Draw a scene.

    Parameters
    ----------
    scene
        The scene.
    target
        The target to draw as a ghost; the framing includes it.
    size
        Width and height in pixels.
    samples
        Rays for each pixel at edges, and a quarter of it elsewhere: 4 for a draft, 16 for a page, 64 for print.
    azimuth, elevation
        The direction of the camera, degrees: 0, 0 looks from +z; azimuth 90 from +x; elevation 90 from above.
    fov
        Vertical field of view, degrees.
    margin
        Empty border as a share of the picture.
    camera
        Eye, target, up and vertical field of view; replaces `azimuth`, `elevation`, `fov` and `margin`.
    backdrop
        "studio", "white", "slate" or "clear" (transparent, with the shadow in the alpha channel).
    lift
        The height of the scene above the floor, as a share of the scene's height.
    frame
        Another scene that determines the framing, so that pictures can be compared.
    like
        Another scene that determines framing, floor and palette, so that pictures of its states agree; `scene` may then
        be empty.
    style, window, under
        Settings of `niwaki.draw.flat.drawing.drawing`, which draws scenes of flat shapes unless `camera` is given.
    obstacles
        Solids that the scene avoids, drawn as ghosts; the framing does not include them.
    ground
        The height of the floor, if the scene may stand above it.

    Returns
    -------
    PIL.Image.Image
        The picture, RGBA.
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
    aims = [] if target is None else [target]
    ghost = _ghost([*aims, *obstacles])
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
    foot = float(low[1] - lift * (high[1] - low[1]))
    view: dict[str, Any] = {"camera": camera, "width": width, "height": height}
    stage: dict[str, Any] = {"samples": samples, "backdrop": BACKDROPS[backdrop]}
    stage["floor"] = foot if ground is None else min(foot, ground)
    color = OBSTACLE["dark" if backdrop == DARK else "light"]
    pixels = _engine.render(shown, ghost, **view, **stage, ghost_color=None if aims else color)
    if aims and obstacles:
        # The engine draws a ghost in one colour: the obstacles' pixels are those of a second picture.
        tinted = _engine.render(shown, ghost, **view, **stage, ghost_color=color)
        here, there = (_opacity(_ghost(solids), view) for solids in (obstacles, aims))
        share = (here / np.maximum(here + there, 1e-9))[..., None]
        pixels = np.rint(pixels + share * (tinted.astype(np.float64) - pixels)).astype(np.uint8)
    return Image.fromarray(pixels, "RGBA")


def _opacity(ghost: _engine.Surfaces | None, view: dict[str, Any]) -> NDArray[np.float64]:
    """Return the opacity of a ghost alone in each pixel, from 0 to 255."""
    return _engine.render(_engine.Surfaces([]), ghost, **view, samples=4)[..., 3].astype(np.float64)


def surfaces(scene: Assembly, like: Assembly | None = None) -> _engine.Surfaces:
    """Make the surfaces of all shapes with their paints, for the engine's `render`."""
    scene = coated(scene)
    return _engine.Surfaces(
        [
            (shape, paint.color, (paint.gloss, paint.metalness, paint.rough, paint.pitch))
            for part, part_paints in zip(scene.parts, paints(scene, like), strict=True)
            for shape, paint in zip(part.shapes, part_paints, strict=True)
        ]
    )


def png(image: Image.Image) -> bytes:
    """Write an image as the bytes of a PNG file."""
    out = io.BytesIO()
    image.save(out, "PNG")
    return out.getvalue()


def save(scene: Assembly, path: str | PathLike[str], target: Volume | None = None, **settings: Any) -> Path:
    """Draw a scene into an image file; `settings` are those of `picture`."""
    return save_image(lambda: picture(scene, target, **settings), path)


def save_image(draw: Any, path: str | PathLike[str]) -> Path:
    """Write the image that `draw()` returns, completely or not at all; the name is checked before drawing."""
    place = check_image(path)
    image: Image.Image = draw()
    out = io.BytesIO()
    kind = Image.registered_extensions()[place.suffix.lower()]
    image.convert("RGB" if kind == "JPEG" else "RGBA").save(out, kind)
    return write_whole(place, out.getvalue())


def check_image(path: str | PathLike[str]) -> Path:
    """Check that a picture can be written: the suffix and the folder.

    Raises
    ------
    FileError
        The suffix is not that of a picture, or the folder does not exist.
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
    """Draw a small PNG picture of a scene, for notebooks; an empty scene gives one transparent pixel."""
    return png(picture(scene, size=(800, 600)) if len(scene) else Image.new("RGBA", (1, 1)))


def _ghost(solids: Sequence[Volume]) -> _engine.Surfaces | None:
    """Make the surface of ghosts, None without solids; its normals are smooth where it is smooth."""
    if not solids:
        return None
    starts = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    vertices = np.concatenate([solid.vertices for solid in solids])
    faces = np.concatenate([solid.faces + start for solid, start in zip(solids, starts, strict=False)])
    shape = _engine.shape("mesh", vertices, faces)
    return _engine.Surfaces([(shape, (1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 0.0))])
