"""Annealed importance sampling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from niwaki.errors.settings import bad, is_number
from niwaki.methods.checks import at_least_one
from niwaki.methods.checks import particles as check_particles
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method


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
        check_particles(self.particles, 2)
        self._set("powers", _ladder(self.powers))
        for name in ("moves", "tries"):
            at_least_one(name, getattr(self, name))
        kernel: Any = self.kernel
        if kernel is None:
            return
        if not isinstance(kernel, Kernel):
            raise bad("kernel", kernel, "a kernel", "one of `niwaki.kernels`, such as `kernels.prior()`")
        changing = kernel.first("anneal", "tempering")
        if changing is not None:
            expected = "a kernel without powers of its own, which annealing and tempering have"
            raise bad("kernel", kernel, expected, f"{changing.parts[0]!r}, and `powers=` of `ais`")


def _ladder(powers: Any) -> int | tuple[float, ...]:
    """The number of rungs, or the powers as numbers."""
    if not isinstance(powers, (list, tuple)):
        return at_least_one("powers", powers)
    rising = all(is_number(power) for power in powers) and all(
        low < high for low, high in zip((0.0, *powers), powers, strict=False)
    )
    if not rising or not powers or powers[-1] != 1:
        raise bad("powers", powers, "a number of rungs, or powers that rise from above 0 to 1", "100")
    return tuple(map(float, powers))


ais = Ais
