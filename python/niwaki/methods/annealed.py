"""Annealed importance sampling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from niwaki.methods.checks import is_kernel
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class Ais(Method):
    """Particles that a chain moves from the prior to the posterior, on a ladder of powers of the score (Neal 2001).

    The mean weight is unbiased for the evidence, and weighted particles follow the posterior, for every ladder and
    every kernel: what the moves miss, the weights count. Runs may differ in structure.

    Parameters
    ----------
    particles
        How many, at least 2. They are independent, and run on all threads.
    powers
        How many rungs the ladder has; or the powers of the score themselves, rising to 1. The k-th of n rungs has the
        power `(k / n) ** 4`.
    kernel
        How particles are moved, a value of `niwaki.kernels`; `kernels.prior()` when left out. It does not adapt: give
        `drift` its scale, and `hmc_step` its step. No `anneal` and no `tempering`.
    moves
        Proposals for each particle at each rung.
    tries
        Most forward runs for the first state of a particle, which must be possible.
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
        is_kernel("kernel", self.kernel)
        self._check()


ais = Ais
