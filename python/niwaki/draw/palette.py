"""Colours for shapes without colours of their own.

There are two palettes: *machine* (warm greys, graphite for round shapes, a burnt orange accent) and *garden* (bark for
limbs, pine greens for the rest). A scene with a limb that has no colour of its own uses *garden*. A shape with a colour
is smooth in both palettes. The tone of a part varies only with its address, so that a part keeps its colour when others
change.
"""

from __future__ import annotations

import colorsys
import zlib
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from niwaki._engine import Shape
from niwaki.draw.assembly import Assembly, Part

Color = tuple[float, float, float]

WARM_GREYS: tuple[Color, ...] = ((0.85, 0.83, 0.79), (0.79, 0.77, 0.73), (0.73, 0.715, 0.69))
GRAPHITES: tuple[Color, ...] = ((0.33, 0.35, 0.38), (0.40, 0.41, 0.43), (0.27, 0.29, 0.32))
ACCENTS: tuple[Color, ...] = ((0.80, 0.37, 0.20), (0.84, 0.45, 0.24))
BARKS: tuple[Color, ...] = ((0.44, 0.35, 0.29),)
PINES: tuple[Color, ...] = ((0.36, 0.47, 0.28), (0.32, 0.43, 0.28), (0.41, 0.50, 0.30))

#: The colour of an obstacle's ghost, on light and on dark backdrops, sRGB: in pictures, and in the studio.
OBSTACLE: dict[str, Color] = {"light": (0.706, 0.337, 0.29), "dark": (0.851, 0.514, 0.478)}

#: The roughness of chalk, and the difference to that of lacquer.
DULL, LACQUER = 0.9, 0.55


@dataclass(frozen=True)
class Paint:
    """The look of a part.

    Attributes
    ----------
    name
        The name of the material in files.
    color
        The colour, sRGB in [0, 1].
    gloss
        From 0 (chalk) to 1 (lacquer).
    rough
        From 0 (smooth) to 1 (foliage); for pictures only.
    pitch
        The size of the bumps of a rough surface, scene units.
    metalness
        From 0 to 1 (metal), as in glTF.
    given_roughness
        The roughness that the model sets, or None.
    is_named
        Whether the model names the material.
    """

    name: str
    color: Color
    gloss: float
    rough: float = 0.0
    pitch: float = 0.0
    metalness: float = 0.0
    given_roughness: float | None = None
    is_named: bool = False

    @property
    def roughness(self) -> float:
        """Roughness from 0 (a mirror) to 1 (chalk), as in glTF."""
        return DULL - LACQUER * self.gloss if self.given_roughness is None else self.given_roughness

    def finished(self, metalness: float | None, roughness: float | None) -> Paint:
        """Return the paint with the metalness and roughness that the model sets."""
        if roughness is not None:
            gloss = min(max((DULL - roughness) / LACQUER, 0.0), 1.0)
            return replace(self, gloss=gloss, metalness=metalness or 0.0, given_roughness=roughness)
        return self if metalness is None else replace(self, metalness=metalness)

    def called(self, material: str | None) -> Paint:
        """Return the paint with the name of the material that the model sets."""
        return self if material is None else replace(self, name=material, is_named=True)


def paints(scene: Assembly, like: Assembly | None = None) -> list[list[Paint]]:
    """Choose the paint of each shape of each part, in order; `like`, if given, determines palette and size."""
    whole = scene if like is None else like
    garden = any(
        shape.tone == "bark" and shape.color is None for part in whole.parts for shape in part.shapes
    )
    extent = whole.size.max() if len(whole) else 1.0
    return [
        [
            _paint(part, shape, garden, extent)
            .finished(shape.metalness, shape.roughness)
            .called(shape.material)
            for shape in part.shapes
        ]
        for part in scene.parts
    ]


def _paint(part: Part, shape: Shape, garden: bool, extent: float) -> Paint:
    dice = zlib.crc32(part.address.encode())
    if shape.color is not None:
        return Paint(named(_triple(shape.color)), _triple(shape.color), 0.35)
    if garden and shape.tone == "bark":
        return Paint("bark", _vary(BARKS, dice, 0.012, 0.0), 0.05, 0.35, 0.012 * extent)
    if garden:
        return Paint("foliage", _vary(PINES, dice, 0.04, 0.012), 0.08, 0.8, 0.016 * extent)
    low, high = shape.aabb()
    sizes = sorted(b - a for a, b in zip(low, high, strict=True))
    if shape.tone == "round":
        return Paint("graphite", _vary(GRAPHITES, dice, 0.05, 0.0), 0.5)
    if sizes[0] < 0.035 * extent or dice % 7 == 0:
        return Paint("accent", _vary(ACCENTS, dice, 0.03, 0.004), 0.35)
    return Paint("warm grey", _vary(WARM_GREYS, dice, 0.05, 0.004), 0.35)


def named(color: Color) -> str:
    """Write a colour as `#rrggbb`."""
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)):02x}" for part in color)


def material_names(materials: Iterable[Paint]) -> list[str]:
    """Make unique names of materials: the second "bark" becomes "bark 2"."""
    counts: Counter[str] = Counter()
    names = []
    for paint in materials:
        counts[paint.name] += 1
        count = counts[paint.name]
        names.append(paint.name if count == 1 else f"{paint.name} {count}")
    return names


def _vary(colors: tuple[Color, ...], dice: int, by: float, turn: float) -> Color:
    """Pick one of `colors` and vary it: lightness by up to `by`, hue by up to `turn`."""
    hue, light, saturation = colorsys.rgb_to_hls(*colors[(dice >> 3) % len(colors)])
    light += ((dice >> 8) % 256 / 127.5 - 1.0) * by
    hue += ((dice >> 16) % 256 / 127.5 - 1.0) * turn
    return colorsys.hls_to_rgb(hue % 1.0, min(max(light, 0.0), 1.0), saturation)


def _triple(color: Sequence[float]) -> Color:
    red, green, blue = color
    return (red, green, blue)
