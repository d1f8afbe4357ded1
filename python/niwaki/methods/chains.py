"""Metropolis-Hastings."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.methods.checks import check_kernel
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method


@dataclass(frozen=True)
class Mh(Method):
    """Markov chains of single runs, changed proposal by proposal (dissertation chapter 3).

    Parameters
    ----------
    steps
        The number of proposals of each chain, with the warm-up.
    strategy
        The part of the model that runs again for a proposal: "c3" (from the changed choice on, without calls whose
        inputs are unchanged), "resume" (from the choice on), "cache" (from the start, without such calls), "rerun" (all
        of it). The states are the same to the bit; only the time differs.
    kernel
        The kernel that proposes, from `niwaki.kernels`; `kernels.prior()` when left out.
    chains
        The number of chains, which run side by side on the threads.
    thin
        The number of proposals between two samples; the default gives `keep` samples. It doubles when samples take too
        much memory.
    keep
        The approximate number of samples of each chain, 1000 when left out; 0 for none (the best state always stays).
    warmup
        The number of proposals before the first sample. Step sizes are adapted in the warm-up only.
    tries
        The most forward runs for a possible first state.
    """

    NAME = "mh"
    steps: int = 10_000
    strategy: str = "c3"
    kernel: Kernel | None = None
    chains: int = 1
    thin: int | None = None
    keep: int | None = None
    warmup: int = 0
    tries: int = 1000

    def __post_init__(self) -> None:
        """Check the settings."""
        check_kernel("kernel", self.kernel, "kernels.drift()")
        self._check()


mh = Mh
