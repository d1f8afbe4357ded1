"""The compatibility model: which colours suit one another on a drawing (dissertation 4.5 and appendix B.1).

Each region without a pinned colour draws red, green and blue, uniform on [0, 1]. The log score is `weight` times a sum:

    saturation          area-weighted sum over regions: near 0.3 on the background, 0.7 elsewhere
    perceptual          mean over neighbours: CIELAB distance near 0.3 of the largest
    lightness           mean over neighbours: near 0.3 apart where one is the background, 0.2 elsewhere
    lightness relation  sum over rules: 15 units apart, within 5
    same chroma         sum over rules: equal a and b, within 5

and three terms that the dissertation does not have:

    lighter             sum over rules: at least 12 units lighter, within 5
    same hue            sum over rules: equal hue, strong or pale
    muted               sum over rules: at most a given distance from grey, within 5

Each of the first five terms is the log of a normal density. The means and sums are of different sizes on purpose: rules
must hold, and the other terms decide among the colourings that keep them. `weight` is 100, as in the dissertation's own
runs (its text leaves it out); a rule's width of 5 then acts like 0.5.
"""

import math
from typing import NamedTuple

from niwaki import factor, model, soft_at_least, soft_at_most, softeq, uniform

# Smaller than any difference that matters: the slope of a square root stays finite where two colours are equal.
TINY = 1e-24
FARTHEST = 300.0  # CIELAB: the root of 100^2 + 200^2 + 200^2
WIDEST = 282.9  # CIELAB: the root of 200^2 + 200^2
KNEE = 216.0 / 24389.0


class Lab(NamedTuple):
    """A colour in CIELAB: lightness, green to red, blue to yellow."""

    l: float  # noqa: E741 (its name everywhere)
    a: float
    b: float


@model
def coloring(
    areas, pairs, lightness, lighter, same_chroma, same_hue, muted, background, pinned, weight=100.0
):
    """Color the regions of a drawing.

    Parameters
    ----------
    areas
        Each region's share of the picture.
    pairs
        Neighbours, as pairs of region numbers.
    lightness, lighter, same_chroma, same_hue
        Rules, as pairs of region numbers, the lighter region first.
    muted
        Rules, as pairs of a region number and the largest distance from grey, CIELAB units.
    background
        The number of the background's region; -1 for none.
    pinned
        The fixed colour of each region, or None.
    weight
        The factor of the whole log score.
    """
    colors = [paint(fixed) for fixed in pinned]
    labs = [to_lab(c[0], c[1], c[2]) for c in colors]
    for i in range(len(areas)):
        factor(weight * areas[i] * softeq(saturation(labs[i]), 0.3 if i == background else 0.7, 1.0))
    share = weight / max(len(pairs), 1)
    for i, j in pairs:
        factor(share * apart(labs[i], labs[j], i == background or j == background))
    for i, j in lightness:
        factor(weight * lightness_relation(labs[i], labs[j]))
    for i, j in same_chroma:
        factor(weight * one_chroma(labs[i], labs[j]))
    for i, j in lighter:
        factor(weight * at_least_lighter(labs[i], labs[j]))
    for i, j in same_hue:
        factor(weight * one_hue(labs[i], labs[j]))
    for i, most in muted:
        factor(weight * near_grey(labs[i], most))
    return colors


def paint(fixed):
    """Return a region's fixed color, or draw one."""
    if fixed is not None:
        return fixed
    r = uniform(0.0, 1.0)
    g = uniform(0.0, 1.0)
    b = uniform(0.0, 1.0)
    return (r, g, b)


def apart(first, second, on_background):
    """Score how well two neighbours can be distinguished."""
    dl, da, db = first.l - second.l, first.a - second.a, first.b - second.b
    distance = math.sqrt(dl * dl + da * da + db * db + TINY)
    return softeq(distance / FARTHEST, 0.3, 0.2) + softeq(abs(dl) / 100.0, 0.3 if on_background else 0.2, 0.4)


def lightness_relation(light, dark):
    """Score that `light` is 15 units lighter than `dark`."""
    return softeq((light.l - dark.l) / 100.0, 0.15, 5.0 / 100.0)


def at_least_lighter(light, dark):
    """Score that `light` is at least 12 units lighter than `dark`."""
    return soft_at_least((light.l - dark.l) / 100.0, 0.12, 5.0 / 100.0)


def one_chroma(first, second):
    """Score that two colors are shades of one color."""
    da, db = first.a - second.a, first.b - second.b
    return softeq(math.sqrt(da * da + db * db + TINY) / WIDEST, 0.0, 5.0 / WIDEST)


def one_hue(first, second):
    """Score that two colors have equal hue, that is direction from grey; loose within 1 unit of grey."""
    u = 1.0 / math.sqrt(first.a * first.a + first.b * first.b + 1.0)
    v = 1.0 / math.sqrt(second.a * second.a + second.b * second.b + 1.0)
    da, db = u * first.a - v * second.a, u * first.b - v * second.b
    return softeq(math.sqrt(da * da + db * db + TINY), 0.0, 0.5)


def near_grey(c, most):
    """Score that a color is at most `most` units from grey."""
    return soft_at_most(math.sqrt(c.a * c.a + c.b * c.b + TINY) / 100.0, most / 100.0, 5.0 / 100.0)


def saturation(c):
    """Saturation: a color's distance from grey, [0, 1]; 0 for black."""
    chroma = c.a * c.a + c.b * c.b
    return math.sqrt(chroma / (chroma + c.l * c.l + TINY) + TINY)


def to_lab(r, g, b):
    """Convert red, green and blue in [0, 1] to CIELAB: a gamma of 2.2, white D65."""
    r, g, b = r**2.2, g**2.2, b**2.2
    x = root((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047)
    y = root(0.2126729 * r + 0.7151522 * g + 0.0721750 * b)
    z = root((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883)
    return Lab(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))


def root(t):
    """Cube root, with a straight line below 216/24389 that continues the root's slope."""
    # Without a branch, so that dark colors do not change the path of the model.
    return max(t, KNEE) ** (1.0 / 3.0) + (min(t, KNEE) - KNEE) * (24389.0 / 27.0 / 116.0)
