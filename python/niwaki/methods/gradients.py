"""Chains that follow the gradient."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np

from niwaki.methods.method import Method


@dataclass(frozen=True)
class Hmc(Method):
    """Chains that follow the gradient for a fixed number of steps (dissertation 4.3).

    The chains keep the structure of their start and the values of its discrete choices, with a warning. To vary these,
    use `mh(kernel=kernels.cycle(kernels.prior(), kernels.hmc_step()))`.

    Parameters
    ----------
    draws
        The number of draws of each chain, after the warm-up.
    steps
        The number of leapfrog steps of a trajectory; the dissertation takes 100 for colours and 1000 for stacks.
    jitter
        The share by which the number of steps varies, [0, 1]; 0, the dissertation's setting, for a fixed number.
    chains
        The number of chains; two or more show whether they agree.
    warmup
        The number of transitions of each chain in which step size and metric are adapted; they are not among the draws.
    thin
        The number of transitions for each draw.
    target_accept
        The mean acceptance to which the step size is adapted, (0, 1).
    metric
        The shape of the target that the warm-up learns: "diagonal", a scale for each coordinate; "low-rank", and a few
        directions; "dense", the whole covariance, for nearly normal targets; "unit", nothing (the dissertation's
        setting). Or fixed numbers: the variance of each coordinate, or a covariance by rows, such as the `metric` of a
        result of `vi`.
    step_size
        A fixed step in place of an adapted one.
    climb
        The most steps uphill from each chain's first run, before the warm-up, for models with tight constraints in
        which almost every run of the prior is far from all likely runs. The steps stop when the gain is small beside
        the spread of draws. 0, the default, for none; `explore` takes up to 2000.
    tries
        The most forward runs for the start of each chain.
    designs
        Whether the draws are for designs and not for estimates, as in `explore`: trajectories that diverged or reached
        another structure are counted without a warning.
    """

    NAME = "hmc"
    draws: int = 1000
    steps: int = 100
    jitter: float = 0.0
    chains: int = 4
    warmup: int = 1000
    thin: int = 1
    target_accept: float = 0.65
    metric: str | tuple[float | tuple[float, ...], ...] = "diagonal"
    step_size: float | None = None
    climb: int = 0
    tries: int = 1000
    designs: bool = False

    def __post_init__(self) -> None:
        """Check the settings."""
        _convert(self)
        self._check()


@dataclass(frozen=True)
class Nuts(Method):
    """Chains that follow the gradient until they turn back (Hoffman & Gelman 2014; Betancourt 2017).

    The chains keep structure and discrete choices, as those of `hmc`.

    Parameters
    ----------
    max_depth
        The most doublings of a trajectory, up to 20: 2^max_depth - 1 steps.
    draws, chains, warmup, thin, target_accept, metric, step_size, climb, tries
        As for `hmc`.
    """

    NAME = "nuts"
    draws: int = 1000
    max_depth: int = 10
    chains: int = 4
    warmup: int = 1000
    thin: int = 1
    target_accept: float = 0.8
    metric: str | tuple[float | tuple[float, ...], ...] = "diagonal"
    step_size: float | None = None
    climb: int = 0
    tries: int = 1000

    def __post_init__(self) -> None:
        """Check the settings."""
        _convert(self)
        self._check()


hmc, nuts = Hmc, Nuts


def explore(draws: int = 8, chains: int = 128, warmup: int = 6, steps: int = 30, climb: int = 2000) -> Hmc:
    """Make a method of many short chains, for designs and not for estimates: each climbs from a run, then samples.

    Tight constraints leave likely runs in separate narrow regions, which one chain crosses slowly or never leaves.
    Chains from many places reach more regions with as many gradients. The weight of each region then depends on the
    starts of the chains, and some chains have not reached the typical set. For estimates, use `nuts` with a long
    warm-up and look at `rhat`. For the same reason trajectories that diverged or reached another structure are counted
    without a warning.

    Parameters
    ----------
    draws, chains, warmup, steps, climb
        As for `hmc`. The lengths vary by half, and there is no metric, because a metric needs more draws.
    """
    return Hmc(
        draws, steps, jitter=0.5, chains=chains, warmup=warmup, metric="unit", climb=climb, designs=True
    )


def _convert(method: Hmc | Nuts) -> None:
    """Make the numbers of a metric tuples."""
    metric: Any = method.metric
    if metric is None or isinstance(metric, str):
        return
    with suppress(TypeError, ValueError):
        rows = np.asarray(metric, dtype=np.float64).tolist()
        if isinstance(rows, list):
            method._set("metric", tuple(tuple(row) if isinstance(row, list) else row for row in rows))
