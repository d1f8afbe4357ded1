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

    They keep the structure of their start and the values of its discrete choices, with a warning; where those should
    vary use `mh(kernel=kernels.cycle(kernels.prior(), kernels.hmc_step()))`.

    Parameters
    ----------
    draws
        Of each chain, after warm-up.
    steps
        Leapfrog steps of a trajectory; the dissertation takes 100 for colours and 1000 for stacks.
    jitter
        The number of steps varies by this share of itself, [0, 1]; 0, the dissertation's setting, keeps it.
    chains
        How many; two or more show whether they agree.
    warmup
        Transitions of each chain in which step size and metric are adapted; not among the draws.
    thin
        Transitions for each draw.
    target_accept
        Mean acceptance that the step size is adapted to, (0, 1).
    metric
        What the warm-up learns of the target's shape: "diagonal", a scale for each coordinate; "low-rank", and a few
        directions; "dense", the whole covariance, which suits nearly normal targets; "unit", nothing (the
        dissertation's setting). Or numbers, kept as they are: the variance of each coordinate, or a covariance by rows,
        such as the `metric` of a result of `vi`.
    step_size
        A step to keep instead of an adapted one.
    climb
        Most steps uphill from each chain's first run, before the warm-up. Useful where tight constraints leave almost
        every run of the prior far from all likely runs. They stop when the gain is small beside the spread of draws. 0,
        the default, for none; `explore` takes up to 2000.
    tries
        Most forward runs for the start of each chain.
    designs
        The draws are for designs and not for estimates, as those of `explore`: trajectories that diverged or were
        refused are counted, and no warning is given.
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

    Structure and discrete choices are kept, as by `hmc`.

    Parameters
    ----------
    max_depth
        Most doublings of a trajectory: 2^max_depth - 1 steps; up to 20.
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
    """Many short chains, for designs rather than for estimates: each starts from its own run, climbs, then samples.

    Tight constraints leave narrow ground in separate places, which one chain crosses slowly or never leaves. Chains
    from many places see more of it with as many gradients. The weight of each place then depends on where the
    chains start, and some chains have not reached the typical set. Where that matters, use `nuts` with a long warm-up
    and look at `rhat`. For the same reason trajectories that diverged or were refused for structure are
    counted, and no warning is given.

    Parameters
    ----------
    draws, chains, warmup, steps, climb
        As for `hmc`, which this is, with lengths that vary by half and no metric: few draws teach none.
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
