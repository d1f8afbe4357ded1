"""Marks of a drawing: filled outlines in the order of painting, and the styles that make them.

ink         the curves and ellipses of the scene
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
        The address of the part.
    corners : list of (x, y)
        A closed polygon, scene units, y upwards.
    fill : tuple of float
        The colour, sRGB in [0, 1].
    blur : float
        The softness of the border, scene units; soft marks add light.
    opacity : float
        The opacity in [0, 1].
    role : str
        The layer of the mark (edge, light, halo, glow) if the part has several; empty for the part itself.
    """

    address: str
    corners: Sequence[Point]
    fill: Rgb
    blur: float = 0.0
    opacity: float = 1.0
    role: str = ""


@dataclass(frozen=True)
class Oval:
    """An ellipse of a scene: its half axes, the angle of the first axis, and the number of sides to draw."""

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
        """Return the corners of the ellipse, scaled by `share`."""
        return ring(self.center, share * self.along, share * self.across, self.angle, self.sides)


@dataclass(frozen=True)
class Style:
    """A style of drawing for flat shapes.

    Attributes
    ----------
    paper : tuple of float
        The colour of the paper, sRGB.
    bend : float
        The bend of the curves: see `curves`.
    stroke, oval : callable
        Functions that return the marks of a stroke and of an ellipse, each with its layer; lower layers come first.
    """

    paper: Rgb
    bend: float
    stroke: Callable[[Stroke, Curve, Rgb], list[tuple[float, Mark]]]
    oval: Callable[[Oval, Rgb], list[tuple[float, Mark]]]


def is_flat(scene: Assembly) -> bool:
    """Whether a scene has shapes, all of them flat."""
    return len(scene) > 0 and all(shape.flat() is not None for part in scene for shape in part.shapes)


def marks(scene: Assembly, style: Style, like: Assembly | None = None) -> list[Mark]:
    """List the marks of a scene in the order of painting.

    Parameters
    ----------
    scene
        A scene of flat shapes.
    style
        The style of the drawing.
    like
        The whole scene of which `scene` is a state; curves bend as in the whole.
    """
    size = float((scene if like is None else like).size[:2].max())
    strokes, ovals, colors = _flat_shapes(scene, size)
    whole = strokes if like is None else _flat_shapes(like, size)[0]
    bent = {
        (stroke.address, stroke.start, stroke.end): curve
        for stroke, curve in zip(whole, curves(whole, style.bend), strict=True)
    }
    layered: list[tuple[float, float, Mark]] = []
    for stroke, color in zip(strokes, colors[: len(strokes)], strict=True):
        curve = bent[stroke.address, stroke.start, stroke.end]
        layered += [(stroke.z, layer, mark) for layer, mark in style.stroke(stroke, curve, color)]
    for oval, color in zip(ovals, colors[len(strokes) :], strict=True):
        layered += [(oval.z, layer, mark) for layer, mark in style.oval(oval, color)]
    return [mark for _, _, mark in sorted(layered, key=lambda entry: entry[:2])]


def _flat_shapes(scene: Assembly, size: float) -> tuple[list[Stroke], list[Oval], list[Rgb]]:
    """Return strokes, ellipses, and the colours of both in this order; `size` is that of the whole drawing."""
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


def _ink_stroke(stroke: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    return [(0.0, Mark(stroke.address, curve.outline(), color))]


def _ink_oval(oval: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    return [(0.0, Mark(oval.address, oval.ring(), color))]


def _vine_stroke(stroke: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    light = curve.outline(wider=0.3, aside=0.17)
    return [
        (
            0.0,
            Mark(stroke.address, curve.outline(more=0.07), mixed(color, (0.0, 0.0, 0.0), 0.45), role="edge"),
        ),
        (0.1, Mark(stroke.address, curve.outline(), color)),
        (0.2, Mark(stroke.address, light, mixed(color, (1.0, 0.86, 0.62), 0.34), role="light")),
    ]


def _vine_oval(oval: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    return _flower(oval, color) if oval.is_disc else _leaf(oval, color)


def _leaf(oval: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    """Draw a pointed leaf from its base to its tip, with a rib; its shade varies with its address."""
    dice = zlib.crc32(oval.address.encode())
    color = mixed(color, (0.78, 0.80, 0.24), 0.35 * (dice % 97) / 97.0)
    dark = mixed(color, (0.05, 0.16, 0.03), 0.45)
    # The leaf is as long as the ellipse, and widest near its base.
    half = [oval.across * sin(pi * t**0.8) ** 0.85 * (1.12 - 0.2 * t) for t in (k / 16 for k in range(17))]
    line = [oval.along * (2.0 * k / 16 - 1.0) for k in range(17)]
    border = [*zip(line, half, strict=True), *((u, -v) for u, v in zip(line[::-1], half[::-1], strict=True))]
    shade = [*zip(line, half, strict=True), *((u, 0.0) for u in line[::-1])]
    rib = [
        (-oval.along, 0.045),
        (0.82 * oval.along, 0.008),
        (0.82 * oval.along, -0.008),
        (-oval.along, -0.045),
    ]
    return [
        (0.0, Mark(oval.address, _placed(oval, border), color)),
        (0.0, Mark(oval.address, _placed(oval, shade), mixed(color, (1.0, 1.0, 0.8), 0.16))),
        (0.0, Mark(oval.address, _placed(oval, rib), dark)),
    ]


def _flower(oval: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    """Draw five petals around a yellow middle; the address determines their turn and shade."""
    dice = zlib.crc32(oval.address.encode())
    start, petals = 2.0 * pi * (dice % 101) / 101.0, []
    color = mixed(color, (0.97, 0.78, 0.86), 0.5 * (dice // 101 % 89) / 89.0)
    for petal in range(5):
        angle = start + 2.0 * pi * petal / 5.0
        center = (
            oval.center[0] + 0.6 * oval.along * cos(angle),
            oval.center[1] + 0.6 * oval.along * sin(angle),
        )
        outer = ring(center, 0.45 * oval.along, 0.4 * oval.along, angle, oval.sides)
        inner = ring(center, 0.36 * oval.along, 0.31 * oval.along, angle, oval.sides)
        petals.append((0.0, Mark(oval.address, outer, mixed(color, (0.45, 0.04, 0.22), 0.4))))
        petals.append((0.0, Mark(oval.address, inner, color)))
    petals.append((0.0, Mark(oval.address, oval.ring(0.27), (0.98, 0.80, 0.25))))
    petals.append((0.0, Mark(oval.address, oval.ring(0.13), (0.86, 0.55, 0.12))))
    return petals


def _bolt(stroke: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    return [
        (0.0, Mark(stroke.address, curve.outline(wider=2.4, more=0.5), color, 1.1, 0.34, "halo")),
        (
            0.1,
            Mark(
                stroke.address,
                curve.outline(wider=1.2, more=0.15),
                mixed(color, (1.0, 1.0, 1.0), 0.3),
                0.34,
                0.6,
                "glow",
            ),
        ),
        (0.2, Mark(stroke.address, curve.outline(wider=0.42), mixed(color, (1.0, 1.0, 1.0), 0.92))),
    ]


def _glow(oval: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    corners = oval.ring()
    return [
        (0.0, Mark(oval.address, corners, color, 0.6, 0.5, "glow")),
        (0.2, Mark(oval.address, corners, color)),
    ]


BOARD: Rgb = (0.045, 0.20, 0.14)
TRACE: Rgb = (0.30, 0.66, 0.42)
TIN: Rgb = (0.86, 0.75, 0.42)


def _trace(stroke: Stroke, curve: Curve, color: Rgb) -> list[tuple[float, Mark]]:
    return [
        (
            0.0,
            Mark(
                stroke.address,
                curve.outline(wider=0.9, more=0.1),
                mixed(BOARD, (0.0, 0.0, 0.0), 0.4),
                role="edge",
            ),
        ),
        (0.1, Mark(stroke.address, curve.outline(wider=0.8), TRACE)),
        (
            0.2,
            Mark(
                stroke.address,
                curve.outline(wider=0.14, aside=0.14),
                mixed(TRACE, (1.0, 1.0, 0.9), 0.4),
                role="light",
            ),
        ),
    ]


def _pad(oval: Oval, color: Rgb) -> list[tuple[float, Mark]]:
    """Draw a disc as a pad with a hole, and an ellipse as an oblong pad with round ends."""
    dark, tin = mixed(BOARD, (0.0, 0.0, 0.0), 0.5), TIN
    if oval.is_disc:
        radii = ((0.86, dark), (0.78, tin), (0.36, dark))
        return [(0.3, Mark(oval.address, oval.ring(size), fill)) for size, fill in radii]
    bars = []
    for size, fill in ((0.60, dark), (0.5, tin)):
        half = size * oval.across
        reach = oval.along - oval.across + half
        ends = [_placed(oval, [(sign * (reach - half), 0.0)])[0] for sign in (-1.0, 1.0)]
        bars.append((0.3, Mark(oval.address, Curve(ends, [2.0 * half] * 2, False).outline(), fill)))
    return bars


def _placed(oval: Oval, corners: Sequence[Point]) -> list[Point]:
    """Move points from the ellipse's own axes to the scene."""
    u, v = cos(oval.angle), sin(oval.angle)
    return [(oval.center[0] + x * u - y * v, oval.center[1] + x * v + y * u) for x, y in corners]


def mixed(a: Rgb, b: Rgb, share: float) -> Rgb:
    """Mix `a` with a share of `b`."""
    red, green, blue = (x + share * (y - x) for x, y in zip(a, b, strict=True))
    return red, green, blue


STYLES: dict[str, Style] = {
    "ink": Style((1.0, 1.0, 1.0), 1.0, _ink_stroke, _ink_oval),
    "vines": Style((0.985, 0.975, 0.945), 1.0, _vine_stroke, _vine_oval),
    "lightning": Style((0.012, 0.012, 0.03), 0.1, _bolt, _glow),
    "circuit": Style(BOARD, 0.0, _trace, _pad),
}


def style_of(name: str) -> Style:
    """Find a style by its name."""
    if name not in STYLES:
        raise FileError("setting", name="style", found=name, expected=", ".join(STYLES))
    return STYLES[name]
