"""Starts of chains: choices of a structure that balances within the tolerance, found by minimisation.

At a draw of the prior the equilibrium factors are many thousand standard deviations away. So the tolerance starts wide
and narrows in steps of ten, and each step maximises the log density (L-BFGS, through SciPy).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from niwaki.errors import ModelFault
from niwaki.lang.models import Model
from niwaki.result.gradient import LogDensity
from niwaki.result.sample import log_density
from niwaki.search import run
from niwaki.stacks.judges import need
from niwaki.stacks.structure import Floats

#: The schedule of tolerances, as multiples of the last one.
WIDER = (300.0, 30.0, 3.0, 1.0)

#: Tolerances of a polish, as multiples of the model's.
FINER = (0.3, 0.1, 1.0 / 30.0)

#: Most draws of the prior that may be impossible because a contact vanishes.
TRIES = 1000

#: Standard deviation of the first coordinates around the middles of their ranges.
SPREAD = 0.3

STEPS = 800

#: The log density that the search for a start uses for an impossible run, in nats.
WALL = 1e30


def start(model: Model[..., Any], seed: int, width: float, **arguments: Any) -> tuple[LogDensity, Floats]:
    """Find coordinates near which a structure balances.

    Parameters
    ----------
    model
        A model of stacks.
    seed
        Seed of the first coordinates.
    width
        The model's tolerance.
    arguments
        The model's other arguments.

    Returns
    -------
    LogDensity
        The log density of the model at this tolerance; its `values` converts coordinates to choices.
    array of shape (dim,)
        The coordinates. They are a start, not a draw.
    """
    random = np.random.default_rng(seed)
    x: Floats | None = None
    for wider in WIDER:
        density = density_of(model, seed, width=wider * width, **arguments)
        density.compile()
        while x is None or _downhill(x, density)[0] == WALL:
            x = SPREAD * random.normal(size=density.dim)
        x = _highest(density, x)
    assert x is not None
    return density, x


def polished(
    model: Model[..., Any], choices: dict[str, Any], width: float, **arguments: Any
) -> dict[str, Any]:
    """Make the balance of a structure more exact, by minimisation. The result is not a draw of the model.

    Parameters
    ----------
    model
        A model of stacks.
    choices
        Choices of a draw.
    width
        The model's tolerance; balance is required within a thirtieth of it.
    arguments
        The model's other arguments.

    Returns
    -------
    dict of str to values
        The choices of the new structure.
    """
    for finer in FINER:
        density = log_density(run(model, choices=choices, width=finer * width, **arguments).best)
        choices = density.values(_highest(density, density.start))
    return choices


def density_of(model: Model[..., Any], seed: int, **arguments: Any) -> LogDensity:
    """Return the log density around the first possible draw of the prior."""
    for number in range(TRIES):
        try:
            return log_density(run(model, seed=seed + number, **arguments).best)
        except ModelFault as fault:
            if fault.code != "impossible-trace" or number == TRIES - 1:
                raise
    raise AssertionError


def height(density: LogDensity, x: Floats) -> tuple[float, Floats]:
    """Return the log density and its gradient; minus infinity and zeros if a contact vanishes."""
    try:
        return density.value_and_gradient(x)
    except ModelFault as fault:
        if fault.code != "impossible-trace":
            raise
        return -np.inf, np.zeros_like(x)


def _highest(density: LogDensity, x: Floats) -> Floats:
    """Return the local maximum that an ascent from `x` reaches."""
    minimize = need("scipy.optimize").minimize
    settings: dict[str, Any] = {"jac": True, "method": "L-BFGS-B", "options": {"maxiter": STEPS}}
    highest: Floats = minimize(_downhill, x, args=(density,), **settings).x
    return highest


def _downhill(x: Floats, density: LogDensity) -> tuple[float, Floats]:
    """Return minus the log density and its gradient; a high constant if the run is impossible."""
    value, gradient = height(density, x)
    return (-value, -gradient) if np.isfinite(value) else (WALL, np.zeros_like(x))
