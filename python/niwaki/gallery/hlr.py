"""Hierarchical linear regression: twenty sequences, each along its own line. Appendix A of the dissertation.

Each sequence has an intercept and a slope; those of all sequences are drawn around a common mean.
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
    """The population's mean intercept and slope, their deviations, and the deviation of a measurement; all lines."""
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
    """Intercept and slope of one sequence."""
    a = gaussian(intercept, intercept_spread)
    b = gaussian(slope, slope_spread)
    for x, y in zip(TIMES, measured):  # noqa: B905 (a model's `zip`; both have five)
        observe(Gaussian(a + b * x, noise), y)
    return a, b


MODEL = hlr
