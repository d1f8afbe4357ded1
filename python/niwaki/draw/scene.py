"""Scenes: the parts that a model emitted, with pictures and files."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from niwaki import draw
from niwaki.draw.assembly import Assembly, Volume

if TYPE_CHECKING:
    from PIL.Image import Image


class Scene(Assembly):
    """A scene: parts in the order of their addresses.

    Parameters
    ----------
    parts
        Parts, or pairs of an address and its shapes.

    Attributes
    ----------
    parts : tuple of Part
    """

    def picture(self, target: Volume | None = None, **settings: Any) -> Image:
        """Draw the scene; see `niwaki.draw.picture.picture`."""
        return draw.picture.picture(self, target, **settings)

    def save(self, path: str | PathLike[str], target: Volume | None = None, **settings: Any) -> Path:
        """Draw the scene into an image file whose name ends in .png, .jpg or .webp."""
        return draw.picture.save(self, path, target, **settings)

    def export(
        self,
        path: str | PathLike[str],
        *,
        scale: float | None = None,
        fuse: float | None = None,
        **settings: Any,
    ) -> Path:
        """Write the scene as .glb, .obj, .ply, .stl, .3mf, .gif, .apng or .svg; see `niwaki.draw.files.export`."""
        return draw.files.export(self, path, scale=scale, fuse=fuse, **settings)

    def animate(self, path: str | PathLike[str], target: Volume | None = None, **settings: Any) -> Path:
        """Write an animation of the growth, part by part, as .gif or .apng; see `niwaki.draw.animation.growth`."""
        return draw.animation.growth(self, path, target, **settings)

    def _repr_png_(self) -> bytes:
        return draw.picture.preview(self)
