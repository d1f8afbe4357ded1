"""Annealed importance sampling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from niwaki.methods.checks import check_kernel
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class Ais(Method):
    """Particles that a chain moves from the prior to the posterior, on a ladder of powers of the score (Neal 2001).

    The mean weight is unbiased for the evidence, and weighted particles follow the posterior, for every ladder and
    every kernel, because the weights correct for the moves. Runs may differ in structure.

    Parameters
    ----------
    particles
        The number of particles, at least 2. They are independent, and run on all threads.
    powers
        The number of rungs of the ladder, or the powers of the score, rising to 1. The k-th of n rungs has the power
        `(k / n) ** 4`.
    kernel
        The kernel that moves particles, from `niwaki.kernels`; `kernels.prior()` when left out. It does not adapt: give
        `drift` its scale, and `hmc_step` its step. `anneal` and `tempering` are refused.
    moves
        The number of proposals for each particle at each rung.
    tries
        The most forward runs for the first state of a particle, which must be possible.
    """

    NAME = "ais"
    particles: int = 100
    powers: int | Sequence[float] = 100
    kernel: Kernel | None = None
    moves: int = 10
    tries: int = 1000

    def __post_init__(self) -> None:
        """Check the settings."""
        if isinstance(self.powers, (list, tuple)):
            self._set("powers", tuple(map(as_real, self.powers)))
        check_kernel("kernel", self.kernel)
        self._check()


ais = Ais
