"""Ascent of a colouring: from a sample to a nearby point where its rules hold as well as possible.

A sample moves along the slope of the model's log density, in the unconstrained coordinates of `niwaki.log_density`. The
steps are those of Kingma & Ba (2015, algorithm 1): each coordinate by the size of its own slopes.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from niwaki.result import Sample

#: Length of the first and last steps, in logits; colours are on a logistic scale.
FIRST, LAST = 0.1, 0.003
SLOPE_MEMORY, SIZE_MEMORY = 0.9, 0.99
#: Decimal digits of colours, and their distance from 0 and 1, where a logit is infinite.
DIGITS, GRAIN = 6, 1e-6


def settled(sample: Sample, steps: int) -> dict[str, Any]:
    """Return the choices of the best point of the ascent from a sample.

    Parameters
    ----------
    sample
        A run whose choices are uniform on [0, 1].
    steps
        The number of steps; 0 keeps the sample's own choices.
    """
    if steps == 0 or not sample.choices:
        return dict(sample.choices)
    density = sample.log_density()
    x = density.start.copy()
    best, highest = -np.inf, x
    slope, size = np.zeros_like(x), np.zeros_like(x)
    for k in range(steps):
        value, gradient = density.value_and_gradient(x)
        if not np.isfinite(value):
            break
        if value > best:
            best, highest = value, x.copy()
        slope = SLOPE_MEMORY * slope + (1.0 - SLOPE_MEMORY) * gradient
        size = SIZE_MEMORY * size + (1.0 - SIZE_MEMORY) * gradient * gradient
        even = slope / (1.0 - SLOPE_MEMORY ** (k + 1))
        scale = np.sqrt(size / (1.0 - SIZE_MEMORY ** (k + 1))) + 1e-9
        x = x + FIRST * (LAST / FIRST) ** (k / steps) * even / scale
    # Rounded far below what the eye sees, so that colours are short to write and to compare.
    values = np.round(np.clip(1.0 / (1.0 + np.exp(-highest)), GRAIN, 1.0 - GRAIN), DIGITS)
    return {choice.name: float(values[choice.first]) for choice in density.choices}
