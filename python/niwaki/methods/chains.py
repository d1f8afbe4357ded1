"""Metropolis-Hastings."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.methods.checks import is_kernel
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method


@dataclass(frozen=True)
class Mh(Method):
    """Markov chains: one state each, changed proposal by proposal (dissertation chapter 3).

    Parameters
    ----------
    steps
        Proposals of each chain, warm-up included.
    strategy
        How much of the model is run again for a proposal: "c3" (from the changed choice on, skipping calls whose inputs
        are unchanged), "resume" (from the choice on), "cache" (from the start, skipping), "rerun" (all of it). The
        states are the same to the bit; only the time differs.
    kernel
        How it proposes, a value of `niwaki.kernels`; `kernels.prior()` when left out.
    chains
        How many, side by side on the machine's threads.
    thin
        Proposals between two samples; when left out as many as give `keep` samples. It doubles when samples take too
        much memory.
    keep
        About how many samples of each chain, 1000 when left out; 0 for none (the best state is always kept).
    warmup
        Proposals before the first sample; step sizes are adapted in them, and never after.
    tries
        Most forward runs for a first state that is possible.
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
        is_kernel("kernel", self.kernel, "kernels.drift()")
        self._check()


mh = Mh
