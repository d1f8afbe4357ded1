"""A line through points with known noise: a model whose evidence and posterior are known in closed form."""

from __future__ import annotations

import math

import niwaki as nw
import numpy as np
from niwaki import model
from niwaki.words import Gaussian

X = np.array([-1.1, -0.3, 0.4, 0.8, 1.6])
Y = np.array([-0.4, 0.4, 1.0, 2.1, 2.3])
NOISE = 0.5


@model
def line(xs, ys):
    slope = nw.gaussian(0.0, 2.0)
    height = nw.gaussian(1.0, 3.0)
    for i in range(len(xs)):
        nw.observe(Gaussian(height + slope * xs[i], 0.5), ys[i])
    return slope


def line_answers() -> tuple[float, np.ndarray, np.ndarray]:
    """Log evidence, mean and covariance of (slope, height)."""
    design = np.column_stack([X, np.ones_like(X)])
    prior, mean = np.diag([4.0, 9.0]), np.array([0.0, 1.0])
    cover = design @ prior @ design.T + NOISE**2 * np.eye(len(X))
    rest = Y - design @ mean
    solved = np.linalg.solve(cover, rest)
    evidence = -0.5 * (rest @ solved + np.linalg.slogdet(2 * math.pi * cover)[1])
    gain = prior @ design.T
    return (
        float(evidence),
        mean + gain @ solved,
        prior - gain @ np.linalg.solve(cover, gain.T),
    )
