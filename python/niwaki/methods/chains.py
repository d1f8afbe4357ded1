"""Metropolis-Hastings."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.errors import InputError
from niwaki.kernels import Kernel
from niwaki.methods.checks import at_least_one, is_whole, one_of

STRATEGIES = ("c3", "rerun", "resume", "cache")


@dataclass(frozen=True)
class Mh:
    """Metropolis-Hastings; see `mh`."""

    steps: int = 10_000
    strategy: str = "c3"
    kernel: Kernel | None = None
    chains: int = 1
    thin: int | None = None
    keep: int = 1000
    warmup: int = 0
    seed: int | None = None
    tries: int = 1000

    @property
    def spacing(self) -> int:
        """Proposals between two samples; 0 for none."""
        if self.keep == 0:
            return 0
        return self.thin if self.thin is not None else max(1, -(-(self.steps - self.warmup) // self.keep))


def mh(
    steps: int = 10_000,
    strategy: str = "c3",
    kernel: Kernel | None = None,
    chains: int = 1,
    thin: int | None = None,
    keep: int = 1000,
    warmup: int = 0,
    seed: int | None = None,
    tries: int = 1000,
) -> Mh:
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
        How it proposes, a value of `niwaki.kernels`; `kernels.mh()` when left out.
    chains
        How many, side by side on the machine's threads.
    thin
        Proposals between two samples; when left out as many as give `keep` samples. It doubles when samples take too
        much memory.
    keep
        About how many samples of each chain; 0 for none (the best state is always kept).
    warmup
        Proposals before the first sample; step sizes are adapted in them, and never after.
    seed
        As for `run`, which comes first.
    tries
        Most forward runs for a first state that is possible.
    """
    for name, value in (("steps", steps), ("chains", chains), ("tries", tries)):
        at_least_one(name, value)
    if thin is not None:
        at_least_one("thin", thin)
    for name, value in (("keep", keep), ("warmup", warmup)):
        if not is_whole(value) or value < 0:
            raise InputError(
                "bad-setting",
                name=name,
                found=repr(value),
                expected="a whole number, 0 or more",
                suggestion="0",
            )
    if warmup >= steps:
        raise InputError(
            "bad-setting",
            name="warmup",
            found=repr(warmup),
            expected="fewer proposals than `steps`",
            suggestion=repr(steps // 5),
        )
    one_of("strategy", strategy, STRATEGIES)
    if kernel is not None and not isinstance(kernel, Kernel):
        raise InputError(
            "bad-setting",
            name="kernel",
            found=repr(kernel),
            expected="a kernel",
            suggestion="one of `niwaki.kernels`, such as `kernels.drift()`",
        )
    return Mh(steps, strategy, kernel, chains, thin, keep, warmup, seed, tries)
