"""Metropolis-Hastings with the original's settings on the models of SMC, and parallel tempering, in equal CPU time.

    .venv/bin/python benches/chains_of_the_original.py [RUNS] [EXPERIMENT ...]

Experiments of `experiments` that fill a volume. SOSMC takes 300 particles, temper 16; each chain gets
the mean CPU time that it took, its first state not counted, and looks at the clock every 500 proposals. Best log
scores are reported at the experiment's own sigma.
"""

import json
import math
import statistics
import sys
import warnings
from typing import Any

import niwaki
from experiments import experiment
from niwaki import kernels
from niwaki.gallery import entry, named_target
from niwaki.search import SearchWarning

AT_ONCE = 500


def chains(nesting: str | None) -> dict[str, Any]:
    """Kernels, by name."""
    hot = kernels.tempering(kernels.original(16.0, nesting), [1.3**-k for k in range(10)], every=10)
    return {"original": kernels.original(16.0, nesting), "original, parallel tempering": hot}


def timed(model: Any, score: Any, kernel: Any, seconds: float, seed: int) -> Any:
    """A chain's result after so many CPU seconds."""
    result: Any = niwaki.run(
        model, method=niwaki.mh(AT_ONCE, kernel=kernel, keep=0), score=score, seed=seed, threads=1
    )
    while result.cpu_seconds < seconds:
        result.more(AT_ONCE)
    return result


def main(runs: int = 10, *names: str) -> int:
    """Measure and print one line for each experiment and method."""
    warnings.simplefilter("ignore", SearchWarning)
    for name in names or ("ship", "building", "tall-tree"):
        chosen = experiment(name)
        model = entry(chosen.model)
        if model is None or chosen.fill is None:
            print(f"skipped: {name} fills no volume")
            continue
        fill = niwaki.match_volume(named_target(chosen.fill), voxel=chosen.voxel, sigma=chosen.sigma)
        score = niwaki.no_self_intersection() * fill
        found: dict[str, list[float]] = {}
        budget = []
        for seed in range(1, runs + 1):
            one = niwaki.run(
                model.model, method=niwaki.smc(300, power=16.0), score=score, seed=seed, threads=1
            )
            found.setdefault("SOSMC, 300", []).append(one.best.log_score)
            budget.append(one.cpu_seconds)
        seconds = statistics.fmean(budget)
        for kind, kernel in chains("side_branch" if chosen.model == "gnarly-tree" else None).items():
            for seed in range(1, runs + 1):
                best = timed(model.model, score, kernel, seconds, seed).best
                found.setdefault(kind, []).append(best.log_score)
        for kind, scores in found.items():
            error = statistics.stdev(scores) / math.sqrt(runs) if runs > 1 else math.nan
            row = {"experiment": name, "method": kind, "runs": runs, "cpu": round(seconds, 3)}
            print(
                json.dumps(row | {"mean": round(statistics.fmean(scores), 2), "error": round(error, 2)}),
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 10, *sys.argv[2:]))
