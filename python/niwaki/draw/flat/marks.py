"""Filled outlines of a drawing, in the order in which they are painted; and the styles, which make them.

ink         what the scene has: curves, ellipses
vines       ellipses are leaves, discs are flowers
lightning   strokes that glow on black
circuit     straight traces; ellipses and discs are pads; in the colours of a board
"""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import cos, pi, sin

from niwaki.draw.assembly import Assembly
from niwaki.draw.flat.strokes import Curve, Point, Stroke, curves, ring, sides_of
from niwaki.draw.palette import paints
from niwaki.errors import FileError

Rgb = tuple[float, float, float]


@dataclass(frozen=True)
class Mark:
    """A filled outline.

    Attributes
    ----------
    address : str
        Of the part that it shows.
    corners : list of (x, y)
        A closed polygon, scene units, y upwards.
    fill : tuple of float
        sRGB in [0, 1].
    blur : float
        How soft its border is, scene units; soft marks are light that is added.
    opacity : float
        In [0, 1].
    role : str
        What it is of its part, where a part's marks lie on several layers; empty for the part itself.
    """

    address: str
    corners: Sequence[Point]
    fill: Rgb
    blur: float = 0.0
    opacity: float = 1.0
    role: str = ""


@dataclass(frozen=True)
class Oval:
    """An ellipse of a scene: its half axes, the angle of the first, and the sides that it is drawn with."""

    address: str
    center: Point
    along: float
    across: float
    angle: float
    z: float
    sides: int

    @property
    def is_disc(self) -> bool:
        """Whether both axes are equal."""
        return abs(self.along - self.across) < 1e-9 * self.along

    def ring(self, share: float = 1.0) -> list[Point]:
        """Its corners, or those of a smaller one of the same form."""
        return ring(self.center, share * self.along, share * self.across, self.angle, self.sides)


@dataclass(frozen=True)
class Style:
    """How flat shapes are drawn.

    Attributes
    ----------
    paper : tuple of float
        sRGB of what is under the drawing.
    bend : float
        Of the curves: see `curves`.
    stroke, oval : callable
        The marks of a stroke and of an ellipse in their colours, each with its layer: marks of lower layers come first.
    """

    paper: Rgb
    bend: float
    stroke: Callable[[Stroke, Curve, Rgb], list[tuple[float, Mark]]]
    oval: Callable[[Oval, Rgb], list[tuple[float, Mark]]]


def is_flat(scene: Assembly) -> bool:
    """Whether there are shapes, and all are flat."""
    return len(scene) > 0 and all(shape.flat() is not None for part in scene for shape in part.shapes)


def marks(scene: Assembly, style: Style, like: Assembly | None = None) -> list[Mark]:
    """The marks of a scene in the order in which they are painted.

    Parameters
    ----------
    scene
        Of flat shapes.
    style
        How they are drawn.
    like
        The whole of which the scene is a state: curves bend as they will then.
    """
    size = float((scene if like is None else like).size[:2].max())
    strokes, ovals, colors = _taken(scene, size)
    whole = strokes if like is None else _taken(like, size)[0]
    bent = {
        (one.address, one.start, one.end): curve
        for one, curve in zip(whole, curves(whole, style.bend), strict=True)
    }
    made: list[tuple[float, float, Mark]] = []
    for one, color in zip(strokes, colors[: len(strokes)], strict=True):
        curve = bent[one.address, one.start, one.end]
        made += [(one.z, layer, mark) for layer, mark in style.stroke(one, curve, color)]
    for oval, color in zip(ovals, colors[len(strokes) :], strict=True):
        made += [(oval.z, layer, mark) for layer, mark in style.oval(oval, color)]
    return [mark for _, _, mark in sorted(made, key=lambda one: one[:2])]


def _taken(scene: Assembly, size: float) -> tuple[list[Stroke], list[Oval], list[Rgb]]:
    """Strokes, ellipses, and the colours of the ones and then of the others; the whole drawing has that size."""
    strokes: list[Stroke] = []
    ovals: list[Oval] = []
    stroked, filled = [], []
    for part, chosen in zip(scene.parts, paints(scene), strict=True):
        for shape, paint in zip(part.shapes, chosen, strict=True):
            flat = shape.flat()
            if flat is None:
                continue
            if len(flat) == 2:
                (a, r), (b, s) = flat
                strokes.append(Stroke(part.address, (a[0], a[1]), (b[0], b[1]), 2.0 * r, 2.0 * s, a[2]))
                stroked.append(paint.color)
            else:
                center, long, wide, angle = flat
                at, sides = (center[0], center[1]), sides_of(0.5 * max(long, wide), size)
                ovals.append(Oval(part.address, at, 0.5 * long, 0.5 * wide, angle, center[2], sides))
                filled.append(paint.color)
    return strokes, ovals, stroked + filled


def _ink_stroke(one: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    return [(0.0, Mark(one.address, curve.outline(), color))]


def _ink_oval(one: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    return [(0.0, Mark(one.address, one.ring(), color))]


def _vine_stroke(one: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    light = curve.outline(wider=0.3, aside=0.17)
    return [
        (0.0, Mark(one.address, curve.outline(more=0.07), mixed(color, (0.0, 0.0, 0.0), 0.45), role="edge")),
        (0.1, Mark(one.address, curve.outline(), color)),
        (0.2, Mark(one.address, light, mixed(color, (1.0, 0.86, 0.62), 0.34), role="light")),
    ]


def _vine_oval(one: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    return _flower(one, color) if one.is_disc else _leaf(one, color)


def _leaf(one: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    """A pointed leaf from its base to its tip, with a rib; its shade varies with its address."""
    dice = zlib.crc32(one.address.encode())
    color = mixed(color, (0.78, 0.80, 0.24), 0.35 * (dice % 97) / 97.0)
    dark = mixed(color, (0.05, 0.16, 0.03), 0.45)
    # Widest near its base, as long as the ellipse.
    half = [one.across * sin(pi * t**0.8) ** 0.85 * (1.12 - 0.2 * t) for t in (k / 16 for k in range(17))]
    line = [one.along * (2.0 * k / 16 - 1.0) for k in range(17)]
    border = [*zip(line, half, strict=True), *((u, -v) for u, v in zip(line[::-1], half[::-1], strict=True))]
    shade = [*zip(line, half, strict=True), *((u, 0.0) for u in line[::-1])]
    rib = [(-one.along, 0.045), (0.82 * one.along, 0.008), (0.82 * one.along, -0.008), (-one.along, -0.045)]
    return [
        (0.0, Mark(one.address, _placed(one, border), color)),
        (0.0, Mark(one.address, _placed(one, shade), mixed(color, (1.0, 1.0, 0.8), 0.16))),
        (0.0, Mark(one.address, _placed(one, rib), dark)),
    ]


def _flower(one: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    """Five petals around a yellow middle, turned and shaded by the address."""
    dice = zlib.crc32(one.address.encode())
    start, made = 2.0 * pi * (dice % 101) / 101.0, []
    color = mixed(color, (0.97, 0.78, 0.86), 0.5 * (dice // 101 % 89) / 89.0)
    for petal in range(5):
        angle = start + 2.0 * pi * petal / 5.0
        center = one.center[0] + 0.6 * one.along * cos(angle), one.center[1] + 0.6 * one.along * sin(angle)
        outer = ring(center, 0.45 * one.along, 0.4 * one.along, angle, one.sides)
        inner = ring(center, 0.36 * one.along, 0.31 * one.along, angle, one.sides)
        made.append((0.0, Mark(one.address, outer, mixed(color, (0.45, 0.04, 0.22), 0.4))))
        made.append((0.0, Mark(one.address, inner, color)))
    made.append((0.0, Mark(one.address, one.ring(0.27), (0.98, 0.80, 0.25))))
    made.append((0.0, Mark(one.address, one.ring(0.13), (0.86, 0.55, 0.12))))
    return made


def _bolt(one: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    return [
        (0.0, Mark(one.address, curve.outline(wider=2.4, more=0.5), color, 1.1, 0.34, "halo")),
        (
            0.1,
            Mark(
                one.address,
                curve.outline(wider=1.2, more=0.15),
                mixed(color, (1.0, 1.0, 1.0), 0.3),
                0.34,
                0.6,
                "glow",
            ),
        ),
        (0.2, Mark(one.address, curve.outline(wider=0.42), mixed(color, (1.0, 1.0, 1.0), 0.92))),
    ]


def _glow(one: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    corners = one.ring()
    return [
        (0.0, Mark(one.address, corners, color, 0.6, 0.5, "glow")),
        (0.2, Mark(one.address, corners, color)),
    ]


BOARD: Rgb = (0.045, 0.20, 0.14)
TRACE: Rgb = (0.30, 0.66, 0.42)
TIN: Rgb = (0.86, 0.75, 0.42)


def _trace(one: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    return [
        (
            0.0,
            Mark(
                one.address,
                curve.outline(wider=0.9, more=0.1),
                mixed(BOARD, (0.0, 0.0, 0.0), 0.4),
                role="edge",
            ),
        ),
        (0.1, Mark(one.address, curve.outline(wider=0.8), TRACE)),
        (
            0.2,
            Mark(
                one.address,
                curve.outline(wider=0.14, aside=0.14),
                mixed(TRACE, (1.0, 1.0, 0.9), 0.4),
                role="light",
            ),
        ),
    ]


def _pad(one: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    """A disc is a pad with a hole; an ellipse an oblong pad, a bar with round ends."""
    dark, tin = mixed(BOARD, (0.0, 0.0, 0.0), 0.5), TIN
    if one.is_disc:
        radii = ((0.86, dark), (0.78, tin), (0.36, dark))
        return [(0.3, Mark(one.address, one.ring(size), fill)) for size, fill in radii]
    made = []
    for size, fill in ((0.60, dark), (0.5, tin)):
        half = size * one.across
        reach = one.along - one.across + half
        ends = [_placed(one, [(sign * (reach - half), 0.0)])[0] for sign in (-1.0, 1.0)]
        made.append((0.3, Mark(one.address, Curve(ends, [2.0 * half] * 2, False).outline(), fill)))
    return made


def _placed(one: Oval, corners: Sequence[Point]) -> list[Point]:
    """From the ellipse's own axes to the scene."""
    u, v = cos(one.angle), sin(one.angle)
    return [(one.center[0] + x * u - y * v, one.center[1] + x * v + y * u) for x, y in corners]


def mixed(a: Rgb, b: Rgb, share: float) -> Rgb:
    """`a`, with that share of `b`."""
    red, green, blue = (x + share * (y - x) for x, y in zip(a, b, strict=True))
    return red, green, blue


STYLES: dict[str, Style] = {
    "ink": Style((1.0, 1.0, 1.0), 1.0, _ink_stroke, _ink_oval),
    "vines": Style((0.985, 0.975, 0.945), 1.0, _vine_stroke, _vine_oval),
    "lightning": Style((0.012, 0.012, 0.03), 0.1, _bolt, _glow),
    "circuit": Style(BOARD, 0.0, _trace, _pad),
}


def style_of(name: str) -> Style:
    """The style of that name."""
    if name not in STYLES:
        raise FileError("setting", name="style", found=name, expected=", ".join(STYLES))
    return STYLES[name]
