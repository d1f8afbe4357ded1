"""Hierarchical linear regression of twenty sequences, each along its own line (dissertation, appendix A).

Each sequence has an intercept and a slope, which are drawn around the means of the population.
"""

from niwaki import model
from niwaki.gallery import data
from niwaki.methods import mh
from niwaki.words import Gaussian, gaussian, observe, uniform

TITLE = "twenty lines and what they have in common"
METHOD = mh(steps=400_000, warmup=100_000)

SEQUENCES = data.growth(200)
TIMES = (-2.0, -1.0, 0.0, 1.0, 2.0)


@model
def hlr(sequences=20):
    """Draw mean and deviation of the intercepts and slopes, the deviation of measurements, and all lines."""
    intercept = gaussian(0.0, 10.0)
    slope = gaussian(0.0, 10.0)
    intercept_spread = uniform(0.05, 3.0)
    slope_spread = uniform(0.05, 3.0)
    noise = uniform(0.05, 3.0)
    lines = [
        line(SEQUENCES[n], intercept, slope, intercept_spread, slope_spread, noise) for n in range(sequences)
    ]
    return (intercept, slope, intercept_spread, slope_spread, noise), lines


def line(measured, intercept, slope, intercept_spread, slope_spread, noise):
    """Draw the intercept and slope of a sequence, and observe its measurements."""
    a = gaussian(intercept, intercept_spread)
    b = gaussian(slope, slope_spread)
    for x, y in zip(TIMES, measured):  # noqa: B905 (a model's `zip`; both have five)
        observe(Gaussian(a + b * x, noise), y)
    return a, b


MODEL = hlr
