"""Colours as vectors of three sRGB parts in [0, 1], with conversions from and to HSV and CIELAB.

The formulas and constants are the same as in the engine's `math/color`. Parts are not clamped: a CIELAB colour that no
screen can show has parts outside of [0, 1].
"""

from __future__ import annotations

import math

from niwaki import _engine
from niwaki.words.vectors import Vec, VecLike, _vec

__all__ = ["color_difference", "hsv", "lab", "rgb", "to_hsv", "to_lab"]

TO_XYZ = (
    (0.4124564, 0.3575761, 0.1804375),
    (0.2126729, 0.7151522, 0.0721750),
    (0.0193339, 0.1191920, 0.9503041),
)
FROM_XYZ = (
    (3.2404548360214087, -1.5371388501025751, -0.498531546868481),
    (-0.9692663898756538, 1.876010928842491, 0.041556082346673545),
    (0.05564341960421367, -0.20402585426769818, 1.057225162457929),
)
WHITE = (0.95047, 1.0000001, 1.08883)
DELTA = 6.0 / 29.0
TAU = 2.0 * math.pi

Three = tuple[float, float, float]


def rgb(color: VecLike | str) -> Vec:
    """Return the three sRGB parts of a colour.

    Parameters
    ----------
    color
        A name of CSS such as "tomato", "#c83c1e" or "#f80", or three numbers.
    """
    parts: Vec = _engine.operation("rgb", color)
    return parts


def hsv(h: float, s: float, v: float) -> Vec:
    """Return the colour with a hue, saturation and value.

    Parameters
    ----------
    h
        Hue in turns: 0 is red, 1/3 green, 2/3 blue; whole turns are ignored.
    s, v
        Saturation and value, in [0, 1].

    Returns
    -------
    Vec
        The colour's sRGB parts.
    """

    def part(n: float) -> float:
        k = n + 6.0 * h
        k = k - 6.0 * math.floor(k / 6.0)
        return v - v * s * max(min(min(k, 4.0 - k), 1.0), 0.0)

    return Vec((part(5.0), part(3.0), part(1.0)))


def to_hsv(color: VecLike | str) -> Vec:
    """Return the hue (in turns, in [0, 1)), saturation and value of a colour; a grey has hue 0.

    Parameters
    ----------
    color
        Three sRGB parts.
    """
    r, g, b = _three(color)
    most, least = max(r, g, b), min(r, g, b)
    chroma = most - least
    if chroma == 0.0:
        return Vec((0.0, 0.0, most))
    if most == r:
        hue = (0.0 + (g - b) / chroma) / 6.0
    elif most == g:
        hue = (2.0 + (b - r) / chroma) / 6.0
    else:
        hue = (4.0 + (r - g) / chroma) / 6.0
    return Vec((hue + 1.0 if hue < 0.0 else hue, 0.0 if most == 0.0 else chroma / most, most))


def lab(l: float, a: float, b: float) -> Vec:  # noqa: E741 (its name everywhere)
    """Return the colour with CIELAB coordinates (white point D65).

    Parameters
    ----------
    l
        Lightness, from 0 (black) to 100 (white).
    a, b
        Position from green to red, and from blue to yellow.

    Returns
    -------
    Vec
        The colour's sRGB parts, outside of [0, 1] if no screen can show the colour.
    """
    y = (l + 16.0) / 116.0
    x, z = y + a / 500.0, y - b / 200.0
    xyz = [_cube(part) * white for part, white in zip((x, y, z), WHITE, strict=True)]
    return Vec(tuple(_displayed(part) for part in _product(FROM_XYZ, xyz)))


def to_lab(color: VecLike | str) -> Vec:
    """Return the CIELAB coordinates of a colour: lightness, green to red, blue to yellow.

    Parameters
    ----------
    color
        Three sRGB parts.
    """
    light = [_linear(part) for part in _three(color)]
    x, y, z = (_root(part / white) for part, white in zip(_product(TO_XYZ, light), WHITE, strict=True))
    return Vec((116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)))


def color_difference(a: VecLike | str, b: VecLike | str) -> float:
    """Return the difference CIEDE2000 of two colours; about 1 is the smallest difference that a person sees.

    See Sharma, Wu & Dalal 2005, equations 2 to 22. The plain distance in CIELAB is `distance(to_lab(a), to_lab(b))`.

    Parameters
    ----------
    a, b
        The sRGB parts of the two colours.
    """
    l1, a1, b1 = to_lab(a).parts
    l2, a2, b2 = to_lab(b).parts
    g = 0.5 * (1.0 - _pull((_length(a1, b1) + _length(a2, b2)) * 0.5))
    a1, a2 = (1.0 + g) * a1, (1.0 + g) * a2
    c1, c2 = _length(a1, b1), _length(a2, b2)
    h1, h2 = _hue(a1, b1, c1), _hue(a2, b2, c2)
    grey = c1 == 0.0 or c2 == 0.0
    turn = 0.0 if grey else h2 - h1
    if turn > TAU / 2.0:
        turn = turn - TAU
    elif turn < -TAU / 2.0:
        turn = turn + TAU
    dl, dc = l2 - l1, c2 - c1
    dh = 0.0 if grey else 2.0 * math.sqrt(c1 * c2) * math.sin(turn * 0.5)
    l, c = (l1 + l2) * 0.5, (c1 + c2) * 0.5  # noqa: E741
    total = h1 + h2
    if grey:
        h = total
    elif abs(h1 - h2) <= TAU / 2.0:
        h = total * 0.5
    else:
        h = (total + TAU) * 0.5 if total < TAU else (total - TAU) * 0.5
    t = (
        1.0
        - 0.17 * math.cos(h - math.radians(30.0))
        + 0.24 * math.cos(2.0 * h)
        + 0.32 * math.cos(3.0 * h + math.radians(6.0))
        - 0.20 * math.cos(4.0 * h - math.radians(63.0))
    )
    bump = (h - math.radians(275.0)) / math.radians(25.0)
    twist = math.radians(60.0) * math.exp(-(bump * bump))
    l50 = (l - 50.0) * (l - 50.0)
    sl = 1.0 + 0.015 * l50 / math.sqrt(20.0 + l50)
    sc = 1.0 + 0.045 * c
    sh = 1.0 + 0.015 * c * t
    rotated = -(2.0 * _pull(c) * math.sin(twist))
    dl, dc, dh = dl / sl, dc / sc, dh / sh
    return math.sqrt(max(dl * dl + dc * dc + dh * dh + rotated * dc * dh, 0.0))


def _three(color: VecLike | str) -> Three:
    red, green, blue = (rgb(color) if isinstance(color, str) else _vec(color)).parts
    return (red, green, blue)


def _product(matrix: tuple[Three, ...], v: list[float]) -> list[float]:
    return [row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in matrix]


def _linear(part: float) -> float:
    return part / 12.92 if part <= 0.04045 else math.pow((part + 0.055) / 1.055, 2.4)


def _displayed(light: float) -> float:
    return light * 12.92 if light <= 0.0031308 else 1.055 * math.pow(light, 1.0 / 2.4) - 0.055


def _root(t: float) -> float:
    return math.pow(t, 1.0 / 3.0) if t > DELTA**3 else t / (3.0 * DELTA * DELTA) + 4.0 / 29.0


def _cube(t: float) -> float:
    return t * t * t if t > DELTA else 3.0 * DELTA * DELTA * (t - 4.0 / 29.0)


def _pull(chroma: float) -> float:
    seventh = chroma**7
    return math.sqrt(seventh / (seventh + 25.0**7))


def _length(a: float, b: float) -> float:
    return math.sqrt(a * a + b * b)


def _hue(a: float, b: float, chroma: float) -> float:
    if chroma == 0.0:
        return 0.0
    angle = math.atan2(b, a)
    return angle + TAU if angle < 0.0 else angle
