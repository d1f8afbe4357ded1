"""Palettes of five colours, in the three stages of dissertation 2.3.2 (figures 2.3 and 2.4).

`wild` draws any five colours. `pastel` draws light colours that are not too vivid, with different neighbours.
`harmonious` also has a main colour (0), two accents (1 and 3) that are split-complementary on the colour wheel, and a
shade of each accent (2 and 4). A colour is a triple of hue (turns), saturation and value. Every factor is added as soon
as its colours exist, so that it guides a search that builds step by step from the first colour on.
"""

from math import cos, pi, radians

from niwaki import model
from niwaki.methods import smc
from niwaki.words import distance, factor, hsv, uniform, vec

TITLE = "palettes of five harmonious colours"
METHOD = smc(particles=20_000, ess=0.5)

COS_60 = cos(radians(60.0))
COS_150 = cos(radians(150.0))


@model
def wild():
    """Draw any five colours."""
    colors = [vec(uniform(0.0, 1.0), uniform(0.0, 1.0), uniform(0.0, 1.0)) for _ in range(5)]
    return swatches(colors)


@model
def pastel():
    """Draw five pastel colours, each different from the colour before."""
    last = soft(uniform(0.0, 1.0))
    colors = [last]
    for _ in range(4):
        last = told_apart(last, soft(uniform(0.0, 1.0)))
        colors = colors + [last]
    return swatches(colors)


@model
def harmonious():
    """Draw a main colour, two accents and a shade of each accent."""
    main = soft(uniform(0.0, 1.0))
    hue = uniform(0.0, 1.0)
    near(turned(hue, main), COS_150, 0.01)
    accent = told_apart(main, soft(hue))
    shade = shade_of(accent)
    hue = uniform(0.0, 1.0)
    near(turned(hue, accent), COS_60, 0.01)
    near(turned(hue, main), COS_150, 0.01)
    other = told_apart(shade, soft(hue))
    other_shade = shade_of(other)
    near((accent.z - shade.z) - (other.z - other_shade.z), 0.0, 0.01)
    return swatches([main, accent, shade, other, other_shade])


def near(x, goal, within):
    """Add a soft constraint: 0 if `x` is at the `goal`, -1 at a distance of `within`."""
    off = (x - goal) / within
    factor(-off * off)


def soft(hue):
    """Draw a colour of a hue, with low saturation and high value."""
    saturation = uniform(0.0, 1.0)
    near(saturation, 0.25, 0.06)
    value = uniform(0.0, 1.0)
    near(value, 0.75, 0.06)
    return vec(hue, saturation, value)


def told_apart(last, color):
    """Keep a colour different from the colour before, and return it."""
    near(distance(last, color), 0.5, 0.06)
    return color


def shade_of(color):
    """Draw another colour of the same hue and saturation."""
    hue = uniform(0.0, 1.0)
    near(turned(hue, color), 1.0, 0.01)
    shade = soft(hue)
    near(color.y - shade.y, 0.0, 0.01)
    return told_apart(color, shade)


def turned(hue, color):
    """Return the cosine of the angle between two hues on the colour wheel."""
    return cos(2.0 * pi * (hue - color.x))


def swatches(colors):
    """Return the colours as sRGB."""
    return [hsv(color.x, color.y, color.z) for color in colors]


MODEL = harmonious
