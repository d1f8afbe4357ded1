"""Variational inference: a normal distribution in place of the model's."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.methods.method import Method


@dataclass(frozen=True)
class Vi(Method):
    """Normal distribution near the model's distribution, and weighted draws from it.

    The normal is over the unconstrained coordinates of the continuous choices: see `niwaki.log_density`. The model must
    make the same choices in every run, and no discrete ones; for other models use `smc`, with a guide of `train_guide`.

    Gradients lead to the normal with the highest evidence bound. Each draw has the weight `p / q`, the ratio of the
    densities of the model and of the normal, smoothed (see `niwaki.diagnostics.psis`). So weighted means are right even
    if the normal is not the model's distribution, as long as `k_hat` is below 0.7.

    Parameters
    ----------
    family
        The family of normals: "mean-field", with independent coordinates; "full-rank", with any covariance;
        "pathfinder", the normals along an ascent of the density (Zhang, Carpenter, Gelman & Vehtari 2022), which is
        the quickest and finds starts for chains. Its draws come from several paths.
    draws
        The number of draws from the normal, or from each path.
    steps
        The most steps of the ascent of the bound; it ends when the bound no longer grows. (Kucukelbir et al. 2017;
        gradients of Roeder, Wu & Duvenaud 2017.)
    samples
        The number of draws for each step.
    tolerance
        The gain of a round of steps below which the ascent ends, nats.
    start
        The start of the ascent: "pathfinder", at the best normal of the paths; "run", around a run.
    paths
        The number of paths, each from its own run. Several paths show whether there are several modes.
    tries
        The most forward runs for the start of each path.
    """

    NAME = "vi"
    family: str = "mean-field"
    draws: int = 1000
    steps: int = 10_000
    samples: int = 16
    tolerance: float = 0.02
    start: str = "pathfinder"
    paths: int = 4
    tries: int = 1000

    def __post_init__(self) -> None:
        """Check the settings."""
        self._check()


vi = Vi
