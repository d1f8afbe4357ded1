"""The settings that we recommend beside the original's weights on our own tall tree, search by search.

    .venv/bin/python benches/tall_tree.py [PARTICLES:SEARCHES ...]

The gnarly tree in our bent tube, cells of 0.4, sigma 0.02, the original's rule for intersections (`surface`), seeds
from 100 on, one thread. For each way: mean, median and worst of the best log scores of the searches that lived, how
many died, the mean difference to the original's weights with its standard error (of the seeds that lived both ways),
and CPU milliseconds of one search.
"""

import math
import statistics
import sys
import time

import niwaki as nw
from niwaki.gallery import entry, named_target
from niwaki.gallery.experiments import RECOMMENDED

SEED = 100


def rising(top: float) -> list[float]:
    """A fifth more for each barrier, up to `top`."""
    return [min(top, 2.0 + 0.2 * k) for k in range(1, 200)]


WAYS = {
    "original": {"weights": "absolute"},
    "recommended": RECOMMENDED,
    "16": {"temper": 16.0},
    "16, adapted at a fifth": {"temper": 16.0, "anneal": 0.2},
    "rising to 16": {"temper": 16.0, "anneal": rising(16.0)},
    "rising to 32": {"temper": 32.0, "anneal": rising(32.0)},
    "rising to 16, when half are effective": {"temper": 16.0, "anneal": rising(16.0), "ess": 0.5},
}


def best(score: nw.Score, particles: int, settings: dict, seed: int) -> tuple[float | None, float]:
    """The best log score of one search, nothing where it died, and its CPU seconds."""
    model, start = entry("gnarly-tree").model, time.process_time()
    try:
        found = nw.run(model, method=nw.smc(particles, **settings), score=score, seed=seed, threads=1)
    except nw.InputError as error:
        if error.code != "everything-impossible":
            raise
        return None, time.process_time() - start
    return found.best.log_score, found.cpu_seconds


def main(*sizes: str) -> int:
    """Measure and print one line for each way and size."""
    target = named_target("bent_tube")
    score = nw.no_self_intersection("surface") * nw.volume_match(target, 0.4, 0.02)
    for size in sizes or ("10:200", "30:100", "100:60", "300:24"):
        particles, searches = (int(part) for part in size.split(":"))
        rows = [
            {name: best(score, particles, settings, seed) for name, settings in WAYS.items()}
            for seed in range(SEED, SEED + searches)
        ]
        for name in WAYS:
            lived = [row[name][0] for row in rows if row[name][0] is not None]
            both = [row for row in rows if row[name][0] is not None and row["original"][0] is not None]
            less = [row[name][0] - row["original"][0] for row in both]
            error = statistics.stdev(less) / math.sqrt(len(less))
            cpu = 1000.0 * statistics.fmean(row[name][1] for row in rows)
            print(
                f"{particles:>5} {name:<38} mean {statistics.fmean(lived):7.2f}  median {statistics.median(lived):7.2f}"
                f"  worst {min(lived):8.2f}  died {searches - len(lived):>3} of {searches}"
                f"  {statistics.fmean(less):+6.2f} ({error:.2f})  {cpu:5.0f} ms",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
