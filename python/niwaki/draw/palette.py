"""Colours for parts whose shapes have none of their own.

Two palettes: *machine* (warm greys, graphite for what is round, a burnt orange accent) and *garden* (bark for limbs,
pine greens for the rest), taken when a scene holds limbs. Each part's tone varies a little with its address and with
nothing else, so that a part keeps its colour when others change.
"""

from __future__ import annotations

import colorsys
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from niwaki._engine import Shape
    from niwaki.scene import Part, Scene

Color = tuple[float, float, float]

WARM_GREYS: tuple[Color, ...] = ((0.80, 0.78, 0.74), (0.74, 0.72, 0.69), (0.69, 0.68, 0.66))
GRAPHITES: tuple[Color, ...] = ((0.33, 0.35, 0.38), (0.40, 0.41, 0.43), (0.27, 0.29, 0.32))
ACCENTS: tuple[Color, ...] = ((0.80, 0.37, 0.20), (0.84, 0.45, 0.24))
BARKS: tuple[Color, ...] = ((0.45, 0.33, 0.25), (0.42, 0.30, 0.22))
PINES: tuple[Color, ...] = ((0.34, 0.49, 0.27), (0.29, 0.44, 0.25), (0.40, 0.54, 0.29))


@dataclass(frozen=True)
class Paint:
    """An sRGB colour in [0, 1] and how it shines, from 0 (chalk) to 1 (lacquer)."""

    color: Color
    gloss: float


def paints(scene: Scene) -> list[list[Paint]]:
    """The paint of each shape of each part, in order."""
    garden = any(shape.kind == "limb" for part in scene.parts for shape in part.shapes)
    extent = scene.size.max() if len(scene) else 1.0
    return [[_paint(part, shape, garden, extent) for shape in part.shapes] for part in scene.parts]


def _paint(part: Part, shape: Shape, garden: bool, extent: float) -> Paint:
    own = shape.color
    limb = shape.kind == "limb"
    if own is not None:
        return Paint(own, 0.06 if limb else 0.12 if garden else 0.35)
    dice = zlib.crc32(part.address.encode())
    if garden:
        return Paint(_vary(BARKS if limb else PINES, dice, 0.10), 0.05 if limb else 0.12)
    low, high = shape.bounds
    sizes = sorted(b - a for a, b in zip(low, high, strict=True))
    if shape.kind.endswith("cylinder"):
        return Paint(_vary(GRAPHITES, dice, 0.05), 0.5)
    thin = sizes[0] < 0.035 * extent
    if thin or dice % 7 == 0:
        return Paint(_vary(ACCENTS, dice, 0.05), 0.35)
    return Paint(_vary(WARM_GREYS, dice, 0.05), 0.35)


def _vary(colors: tuple[Color, ...], dice: int, by: float) -> Color:
    """One of `colors`, a little lighter or darker and turned by a degree or two."""
    hue, light, saturation = colorsys.rgb_to_hls(*colors[(dice >> 3) % len(colors)])
    lift = ((dice >> 8) % 256 / 255.0 - 0.5) * by
    turn = ((dice >> 16) % 256 / 255.0 - 0.5) * 0.02
    return colorsys.hls_to_rgb((hue + turn) % 1.0, min(max(light + lift, 0.0), 1.0), saturation)
