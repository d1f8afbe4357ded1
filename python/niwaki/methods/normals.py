"""Variational inference: a normal distribution in place of the model's."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.methods.method import Method


@dataclass(frozen=True)
class Vi(Method):
    """A normal distribution that is near the model's, and weighed draws from it.

    It is over the unconstrained coordinates of the continuous choices: see `niwaki.log_density`. The model must make
    the same choices in every run, and no discrete ones; for others use `smc`, with a guide of `train_guide`.

    The normal with the highest evidence bound is looked for, by gradients. Each draw has the weight `p / q`, the ratio
    of the model's density and the normal's, smoothed (see `niwaki.diagnostics.psis`). So means by weight are right even
    where the normal is not the model's distribution, as long as `k_hat` is below 0.7.

    Parameters
    ----------
    family
        Which normals: "mean-field", where coordinates are independent; "full-rank", with any covariance; "pathfinder",
        those that an ascent of the density meets on its way (Zhang, Carpenter, Gelman & Vehtari 2022), which is the
        quickest and finds starts for chains; its draws are those of several paths.
    draws
        From the normal; of each path.
    steps
        Steps of the ascent of the bound at most; it ends by itself when the bound grows no more. (Kucukelbir et al.
        2017; gradients of Roeder, Wu & Duvenaud 2017.)
    samples
        Draws for each step.
    tolerance
        The ascent ends when a round of steps gains less, nats.
    start
        Where the ascent starts: "pathfinder", at the best normal of the paths; "run", around a run.
    paths
        How many paths, each from its own run. Several show whether there are several modes.
    tries
        Most forward runs for the start of each path.
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
