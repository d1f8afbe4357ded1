"""Pictures of a scene as its image or shadow sketch sees it: the target, the actual picture, and their difference.

In the difference, ink is right, blue is missing, orange is surplus. The last panel is the scene itself from the same
camera; for a shadow it lies over the shadow that it casts.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from niwaki.draw.flat.drawing import drawing
from niwaki.draw.picture import Camera as Eye
from niwaki.draw.picture import picture, save_image
from niwaki.draw.scene import Scene
from niwaki.targets.camera import Camera
from niwaki.targets.fit import Fit
from niwaki.targets.sketches import View

Rgb = tuple[int, int, int]

PAPER: Rgb = (243, 241, 236)
INK: Rgb = (58, 60, 66)
MISSING: Rgb = (92, 148, 204)
SURPLUS: Rgb = (226, 138, 84)
SHADE: Rgb = (186, 181, 172)
#: Vertical field of view, degrees, in place of parallel rays.
FLAT = 1.5


def view_sheet(
    scene: Scene,
    view: View,
    *,
    height: int = 360,
    samples: int = 16,
    captions: bool = True,
    style: str = "ink",
) -> Image.Image:
    """Draw a scene through the camera of an image or shadow sketch, beside the image to match.

    Parameters
    ----------
    scene
        The scene to draw.
    view
        One of `score.views`.
    height
        Height of each panel, pixels.
    samples
        Rays for each pixel of the panel that shows the scene itself.
    captions
        Whether to write a caption below each panel.
    style
        Style of a drawing.

    Returns
    -------
    PIL.Image.Image
        RGB; four panels from left to right: target, result, difference, scene.
    """
    target, mask = view.image, view.mask(scene)
    rows, columns = target.shape
    size = (max(1, round(height * columns / rows)), height)
    result = {"image": "silhouette", "shadow": "shadow", "drawing": "touched"}[view.kind]
    panels = [
        (colored([(target, INK)], size), "wanted"),
        (colored([(mask, INK)], size), result),
        (
            colored([(target & mask, INK), (target & ~mask, MISSING), (mask & ~target, SURPLUS)], size),
            f"difference: {Fit.of_masks(target, mask)}",
        ),
        (
            through_camera(scene, view, size, samples=samples, style=style),
            "drawn" if view.kind == "drawing" else "from its camera",
        ),
    ]
    gap = max(2, height // 90)
    text_height = max(11, round(height / 24))
    strip = round(2.2 * text_height) if captions else 0
    page = Image.new("RGB", (4 * (size[0] + gap) - gap, height + strip), (255, 255, 255))
    pen, font = ImageDraw.Draw(page), ImageFont.load_default(text_height)
    for k, (panel, caption) in enumerate(panels):
        x = k * (size[0] + gap)
        page.paste(panel, (x, 0))
        if captions:
            pen.text((x + size[0] / 2, height + 0.5 * strip), caption, (84, 82, 78), font, anchor="mm")
    return page


def through_camera(
    scene: Scene, view: View, size: tuple[int, int], *, samples: int = 16, style: str = "ink"
) -> Image.Image:
    """Draw the scene itself as a sketch sees it, over the shadow that it casts or the drawing that it follows."""
    if view.camera is None:
        return drawing(scene, size=size, style=style, window=view.window, under=view.image).convert("RGB")
    under = colored([(view.mask(scene), SHADE)] if view.kind == "shadow" else [], size)
    if len(scene) == 0:
        return under
    # The renderer's own floor, with its shadow, lies far below the picture.
    image = picture(scene, size=size, samples=samples, camera=eye(view.camera), backdrop="clear", lift=1e3)
    under.paste(image, (0, 0), image)
    return under


def eye(camera: Camera) -> Eye:
    """Return the renderer's camera. It has no parallel rays: the camera goes far away instead."""
    if camera.kind == "perspective":
        return (camera.position, camera.look_at, camera.up, camera.fov_degrees)
    away = np.subtract(camera.position, camera.look_at)
    away = away / np.linalg.norm(away) * (camera.height / 2 / np.tan(np.radians(FLAT / 2)))
    x, y, z = (np.asarray(camera.look_at) + away).tolist()
    return ((x, y, z), camera.look_at, camera.up, FLAT)


def colored(layers: list[tuple[NDArray[np.bool_], Rgb]], size: tuple[int, int]) -> Image.Image:
    """Draw masks in their colours on paper, at another size with smooth edges."""
    page = Image.new("RGB", size, PAPER)
    for mask, color in layers:
        alpha = Image.fromarray(np.where(mask, np.uint8(255), np.uint8(0)), "L")
        small = size[0] < mask.shape[1]
        alpha = alpha.resize(size, Image.Resampling.BOX if small else Image.Resampling.BICUBIC)
        page.paste(color, (0, 0), alpha)
    return page


def save_view(path: str | PathLike[str], scene: Scene, view: View, **settings: Any) -> Path:
    """Write `view_sheet` into an image file."""
    return save_image(lambda: view_sheet(scene, view, **settings), path)
