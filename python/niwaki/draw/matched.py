"""What a scene does for an image that it should match: where both agree, what is missing, what is too much.

Left, the scene as the camera of the wish sees it; right, the sketch's own pixels: dark where wish and scene agree,
orange where the scene misses, blue where it has too much.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from niwaki.draw.picture import Camera as Eye
from niwaki.draw.picture import picture
from niwaki.scene import Scene

if TYPE_CHECKING:
    from niwaki.camera import Camera
    from niwaki.sketches import View

#: sRGB, 8 bits: nothing, agreed, missing, too much.
PAPER, AGREED, MISSING, EXTRA = (246, 244, 240), (62, 66, 72), (224, 122, 52), (74, 120, 178)

#: An orthographic camera is drawn as one so many picture heights away.
FAR = 150.0


def matched(scene: Scene, view: View, *, height: int = 480, **settings: Any) -> Image.Image:
    """Draws a scene beside the image that it should match.

    Parameters
    ----------
    scene
        What to draw.
    view
        The wish: one of a score's `views`.
    height
        Of each half, pixels; the width follows the image.
    settings
        As for `niwaki.draw.picture.picture`.
    """
    rows, columns = view.image.shape
    width = max(1, round(height * columns / rows))
    drawn = Scene([*scene.parts, *_receiver(view)])
    left = picture(drawn, camera=eye(view.camera), size=(width, height), **settings)
    right = comparison(scene, view).resize((width, height), Image.Resampling.NEAREST)
    letters = max(11, round(height / 26))
    strip = round(2.2 * letters)
    page = Image.new("RGBA", (2 * width + 4, height + strip), (*PAPER, 255))
    page.paste(left, (0, 0))
    page.paste(right, (width + 4, 0))
    pen, font = ImageDraw.Draw(page), ImageFont.load_default(letters)
    words = [("agrees", AGREED), ("missing", MISSING), ("too much", EXTRA)]
    x, y = width + 4 + letters, height + strip / 2
    for word, color in words:
        pen.rectangle((x, y - letters / 2, x + letters, y + letters / 2), color)
        pen.text((x + 1.5 * letters, y), word, (84, 82, 78, 255), font, anchor="lm")
        x += 3 * letters + round(font.getlength(word))
    return page


def comparison(scene: Scene, view: View) -> Image.Image:
    """The sketch's own pixels, one for each of the wish."""
    wished, found = np.asarray(view.image), np.asarray(view.mask(scene))
    pixels = np.empty((*wished.shape, 3), dtype=np.uint8)
    pixels[:] = PAPER
    pixels[wished & found] = AGREED
    pixels[wished & ~found] = MISSING
    pixels[~wished & found] = EXTRA
    return Image.fromarray(pixels, "RGB")


def eye(camera: Camera) -> Eye:
    """A camera of a wish as the ray caster takes it: eye, target, up and vertical field of view, degrees."""
    if camera.kind == "perspective":
        return (camera.position, camera.look_at, camera.up, camera.fov_degrees)
    # Rays that are parallel come from far away: the field of view shrinks as the distance grows.
    back = np.subtract(camera.position, camera.look_at)
    back = back / np.linalg.norm(back)
    x, y, z = (float(c) for c in np.add(camera.look_at, FAR * camera.height * back))
    return ((x, y, z), camera.look_at, camera.up, math.degrees(2.0 * math.atan(0.5 / FAR)))


def _receiver(view: View) -> list[tuple[str, list[Any]]]:
    """What the shadow falls on, as a part."""
    if view.receiver is None:
        return []
    from niwaki._engine import Shape

    return [("receiver", [Shape.mesh(view.receiver.vertices, view.receiver.faces, color=(0.9, 0.89, 0.87))])]
