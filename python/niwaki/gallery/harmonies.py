"""Palettes whose harmony is a choice, explored in one chain with many modes (dissertation 2.3.2 and 7.1).

The chain chooses the scheme of the colour wheel, which `palettes.harmonious` fixes, and the colours that get shades.
So a palette of five has one accent and three shades, or two of each. These choices are discrete, and decide which other
choices exist; hues, saturations and values are real. The constraint is tight: each colour differs from the colour
before by the same amount, to a hundredth. A colour is a triple of hue (turns),
saturation and value.

`KERNEL` moves the discrete choices by Metropolis-Hastings and the real choices along their gradient, at several powers
of the score: at low powers the scheme changes, and at high powers the colours become exact.
"""

from math import pi

from niwaki import kernels, model
from niwaki.methods import mh
from niwaki.words import (
    beta,
    choose,
    color_difference,
    discrete_uniform,
    factor,
    gaussian,
    hsv,
    softeq,
    truncated_gaussian,
    uniform,
    vec,
    von_mises,
)

TITLE = "palettes of many harmonies, by one chain"

#: Schemes of the colour wheel, all equally likely: the places of the accents, in degrees from the main hue.
SCHEMES = {"complementary": 0.25, "split complementary": 0.25, "triad": 0.25, "analogous": 0.25}
ANGLES = {
    "complementary": (180.0,),
    "split complementary": (150.0, 210.0),
    "triad": (120.0, 240.0),
    "analogous": (-32.0, 32.0),
}

#: Number of colours of a palette, difference of neighbours (CIEDE2000), and its tolerance.
COLORS, APART, WITHIN = 5, 25.0, 0.25

#: Moves of discrete choices by Metropolis-Hastings, and of all real choices along their gradient.
BOTH = kernels.cycle(
    kernels.repeat(3, kernels.on(["scheme", "of"], kernels.prior())), kernels.hmc_step(steps=10, jitter=0.5)
)
KERNEL = kernels.tempering(BOTH, powers=(1, 4**-1, 4**-2, 4**-3, 4**-4, 4**-5), every=8)
METHOD = mh(steps=40_000, warmup=8_000, thin=32, kernel=KERNEL)


@model
def harmonies():
    """Draw a scheme, a main colour, its accents and shades; return (scheme, colours as sRGB)."""
    scheme = choose(SCHEMES)
    colors = [colored(von_mises(0.0, 0.0) / (2.0 * pi))]
    for angle in ANGLES[scheme]:
        # The distance of the accent from its place; the accent moves with its place when the scheme changes.
        off = gaussian(0.0, 0.008)
        colors = colors + [colored(colors[0].x + angle / 360.0 + off)]
    for _ in range(COLORS - len(colors)):
        of = discrete_uniform(0, len(ANGLES[scheme]))
        saturation = truncated_gaussian(colors[of].y, 0.05, 0.0, 1.0)
        colors = colors + [vec(colors[of].x, saturation, uniform(0.25, 1.0))]
    shown = [hsv(color.x, color.y, color.z) for color in colors]
    for i in range(1, COLORS):
        factor(softeq(color_difference(shown[i - 1], shown[i]), APART, WITHIN))
    return (scheme, shown)


def colored(hue):
    """Draw a colour of a hue, neither grey nor dark."""
    return vec(hue, beta(5.0, 6.0), beta(8.0, 2.5))


MODEL = harmonies
