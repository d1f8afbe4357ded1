"""Distinct results on the gnarly tree: what moves, particle Gibbs and separate rows do to a population of copies.

    .venv/bin/python benches/rejuvenation.py [SEEDS] [WAY ...]

The tree in the bent tube, voxel 0.4, sigma 0.02, one thread. Every way gives 100 results. For each: the mean of

- `distinct`: results of which no other shares more than half of its (address, value) pairs, which is what
  `Result.unique_models` counts,
- `apart`: the same where values count as shared when they are within a tenth of their spread over all results of the
  way: a small step of everything makes no tree that a person would call another,
- the best log score, and its difference from that of `plain` for the same seed (mean, standard error),
- CPU seconds.
"""

import json
import math
import statistics
import sys
import time
import warnings
from typing import Any

import niwaki
from niwaki import kernels
from niwaki.gallery import named_target
from niwaki.gallery.gnarly_tree import gnarly_tree
from niwaki.infer import SearchWarning

N = 100
TEMPER = 16.0


def smc(particles: int = N, **settings: Any) -> Any:
    """A population at the temper of `grow`."""
    return niwaki.smc(particles, temper=TEMPER, **settings)


def moving(kernel: Any, moves: int, at: Any, **settings: Any) -> Any:
    """The same with moves."""
    return smc(rejuvenate=kernel, moves=moves, at=at, **settings)


def drifts() -> Any:
    """One choice at a time: small and large steps, and values from the prior."""
    return kernels.mixture(kernels.drift(0.3), kernels.drift(0.05), kernels.mh(), weights=[4, 2, 1])


def shake(step: float) -> Any:
    """Every real choice of the tree moves a little at once; its coins stay."""
    return kernels.on(["yaw", "pitch", "length", "end", "angle", "thick"], kernels.block(step, 1.0))


WAYS = {
    "plain": lambda: smc(),
    "plain, 700": lambda: smc(700),
    "plain, 2500": lambda: smc(2500),
    "shaken at the end, 4": lambda: moving(shake(0.003), 4, "end"),
    "shaken at the end, 40": lambda: moving(shake(0.01), 40, "end"),
    "moved at the end, 300": lambda: moving(drifts(), 300, "end"),
    "moved at each barrier, 1": lambda: moving(drifts(), 1, 1),
    "rows of 10, diverse": lambda: smc(10, diverse=100),
    "particle Gibbs, 10": lambda: niwaki.particle_gibbs(10, N, temper=TEMPER),
}


def shared(runs: list[dict[str, Any]], close: dict[str, float]) -> int:
    """How many runs there are of which no other has most choices, up to what is close."""

    def same(address: str, a: Any, b: Any) -> bool:
        return abs(a - b) <= close[address] if isinstance(a, float) else bool(a == b)

    def has_most(b: dict[str, Any], a: dict[str, Any]) -> bool:
        common = sum(address in b and same(address, value, b[address]) for address, value in a.items())
        return 2 * common > len(a)

    return sum(not any(other is not run and has_most(other, run) for other in runs) for run in runs)


def apart(result: Any) -> int:
    """Distinct results where close values count as shared."""
    runs = [dict(sample.choices) for sample in result]
    found: dict[str, list[float]] = {}
    for run in runs:
        for address, value in run.items():
            if isinstance(value, float):
                found.setdefault(address.rsplit("/", 1)[-1], []).append(value)
    spread = {name: 0.1 * statistics.pstdev(values) for name, values in found.items()}
    return shared(
        runs, {address: spread.get(address.rsplit("/", 1)[-1], 0.0) for run in runs for address in run}
    )


def main(seeds: int = 20, *names: str) -> int:
    """Measure and print one line for each way."""
    warnings.simplefilter("ignore", SearchWarning)
    score = niwaki.no_self_intersection() * niwaki.volume_match(
        named_target("bent_tube"), voxel=0.4, sigma=0.02
    )
    first: list[float] = []
    for name in names or WAYS:
        rows: dict[str, list[float]] = {"distinct": [], "apart": [], "best": [], "similarity": [], "cpu": []}
        moved = [0, 0, 0, 0]
        for seed in range(1, seeds + 1):
            began = time.process_time()
            result = niwaki.run(gnarly_tree, method=WAYS[name](), score=score, seed=seed, threads=1)
            rows["cpu"].append(time.process_time() - began)
            result.samples = result.samples[:N]
            rows["distinct"].append(result.unique_models or 0)
            rows["best"].append(result.best.log_score)
            rows["similarity"].append(result.best.similarity or 0.0)
            if seed <= 3:
                rows["apart"].append(apart(result))
            if result.moved is not None:
                moved = [sum(pair) for pair in zip(moved, (*result.moved[0], *result.moved[1]), strict=True)]
        if name == "plain":
            first = rows["best"]
        told: dict[str, Any] = {key: round(statistics.fmean(values), 3) for key, values in rows.items()}
        if first and name != "plain":
            steps = [a - b for a, b in zip(rows["best"], first, strict=True)]
            error = statistics.stdev(steps) / math.sqrt(len(steps)) if len(steps) > 1 else math.nan
            told["best less plain"] = [round(statistics.fmean(steps), 3), round(error, 3)]
        if any(moved):
            told["moves kept, running"] = f"{moved[1]} of {moved[0]}"
            told["moves kept, ended"] = f"{moved[3]} of {moved[2]}"
        print(json.dumps({"way": name, "seeds": seeds} | told), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 20, *sys.argv[2:]))
