"""Palettes whose harmony is a choice, explored in one chain with many modes (dissertation 2.3.2 and 7.1).

What `palettes.harmonious` fixes is here decided by the chain: which scheme of the colour wheel holds, and which accents
have a shade, so that a palette has two to five colours. Those choices are discrete, and change what other choices there
are; hues, saturations and values are real. `KERNEL` moves the first by Metropolis-Hastings and the second along their
gradient. A colour is a triple of hue (turns), saturation and value.
"""

from math import pi

from niwaki import kernels
from niwaki.methods import mh
from niwaki.words import (
    beta,
    categorical,
    color_difference,
    factor,
    flip,
    gaussian,
    hsv,
    model,
    soft_at_least,
    softeq,
    truncated_gaussian,
    uniform,
    vec,
    von_mises,
)

TITLE = "palettes of many harmonies, by one chain"

#: Schemes of the colour wheel: where the accents stand, degrees from the main hue.
SCHEMES = ("complementary", "split complementary", "triad", "analogous")
ANGLES = ((180.0,), (150.0, 210.0), (120.0, 240.0), (-32.0, 32.0))

#: How different neighbours are at least (CIE76), and how sharply that is meant.
APART, WITHIN = 30.0, 2.0

KERNEL = kernels.cycle(kernels.on(["scheme", "shaded"], kernels.mh()), kernels.hmc(steps=12, jitter=0.5))
METHOD = mh(steps=24_000, warmup=4_000, thin=20, kernel=KERNEL)


@model
def harmonies():
    """A scheme, a main colour, its accents, and shades of some of them; (scheme, colours as they are shown)."""
    scheme = categorical([0.25, 0.25, 0.25, 0.25])
    main = colored(von_mises(0.0, 0.0) / (2.0 * pi))
    colors = [main]
    for angle in ANGLES[scheme]:
        hue = gaussian(main.x + angle / 360.0, 0.008)
        accent = colored(hue)
        # Accents are about as vivid as the main colour.
        factor(softeq(accent.y, main.y, 0.08))
        colors = colors + [accent]
        shaded = flip(0.5)
        if shaded:
            saturation = truncated_gaussian(accent.y, 0.05, 0.0, 1.0)
            value = uniform(0.25, 1.0)
            colors = colors + [vec(gaussian(hue, 0.008), saturation, value)]
    shown = [hsv(color.x, color.y, color.z) for color in colors]
    for i in range(1, len(shown)):
        factor(soft_at_least(color_difference(shown[i - 1], shown[i]), APART, WITHIN))
    return (scheme, shown)


def colored(hue):
    """A colour of that hue, neither grey nor dark."""
    return vec(hue, beta(5.0, 6.0), beta(8.0, 2.5))


MODEL = harmonies
