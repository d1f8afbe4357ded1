"""Our rates: a chain in its first state, proposals before the clock starts, then proposals in CPU time.

One thread; the CPU time is that of the process and holds nothing but the proposals: no samples are kept, and what a
call of the engine costs by itself (a pool of one thread) is measured and taken off.
"""

import statistics
import time
from dataclasses import dataclass
from typing import Any

import niwaki
from niwaki.methods.kernels import Kernel


@dataclass(frozen=True)
class Rate:
    """Proposals and the CPU seconds they took; `counters` are those of the engine, per proposal."""

    proposals: int
    cpu_seconds: float
    counters: dict[str, float]

    @property
    def per_second(self) -> float:
        return self.proposals / self.cpu_seconds


class Timed:
    """A chain that is timed in windows, so that several can take turns."""

    def __init__(
        self,
        model: Any,
        *arguments: Any,
        kernel: Kernel | None = None,
        strategy: str = "c3",
        seed: int = 1,
        score: Any = None,
    ) -> None:
        method = niwaki.mh(steps=1, keep=0, strategy=strategy, kernel=kernel)
        self.result = niwaki.run(model, *arguments, method=method, seed=seed, threads=1, score=score)
        self.engine = self.result.info.running.chains
        self.floor = statistics.median(self.seconds(1) for _ in range(21))

    def seconds(self, proposals: int) -> float:
        """CPU seconds of so many proposals, and of one call of the engine."""
        start = time.process_time()
        self.engine.advance(proposals, 1, None)
        return time.process_time() - start

    def warm(self, seconds: float) -> "Timed":
        """Proposals for so long, untimed."""
        self.window(seconds)
        return self

    def window(self, seconds: float) -> Rate:
        """Proposals for about so many CPU seconds."""
        before, proposals, spent, block = self.engine.counters(), 0, 0.0, 16
        while spent < seconds:
            elapsed = max(self.seconds(block) - self.floor, 1e-9)
            proposals, spent = proposals + block, spent + elapsed
            # Up to a hundredth of a second to a call at first, then a fifth of the window.
            aim = max(0.01, seconds / 5)
            block = max(16, min(int(block * aim / elapsed), block * 8))
        after = self.engine.counters()
        per = {
            key: (after[key] - before[key]) / proposals for key in after if key not in ("bytes", "choices")
        }
        return Rate(proposals, spent, per | {key: after[key] for key in ("bytes", "choices")})


def first_thousand(model: Any, *arguments: Any, kernel: Kernel | None = None, seeds: int = 9) -> float:
    """Proposals per CPU second over the first thousand, the median of fresh chains."""
    rates = []
    for seed in range(seeds):
        method = niwaki.mh(steps=1, keep=0, kernel=kernel)
        engine = niwaki.run(model, *arguments, method=method, seed=seed, threads=1).info.running.chains
        start = time.process_time()
        engine.advance(1000, 1, None)
        whole = time.process_time() - start
        floor = []
        for _ in range(5):
            start = time.process_time()
            engine.advance(1, 1, None)
            floor.append(time.process_time() - start)
        rates.append(1000 / (whole - statistics.median(floor)))
    return statistics.median(rates)
