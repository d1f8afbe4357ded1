"""The lower tail of best scores: the original's weights beside correct ones, at equal numbers of particles.

    NIWAKI_REFERENCE_TARGETS=folder .venv/bin/python benches/tails.py [BLOCKS] [PARTICLES ...]

The spaceship in shipProxy2.obj, voxel 0.25, sigma 0.02, the original's rule for intersections (`surface`). Each search
gives the best log score of its final set, always reported at sigma 0.02. For each weighting: the mean over all runs
and the mean over BLOCKS of the worst of ten runs, each with its standard error, and CPU seconds of one search on one
thread. Weightings with the same particles get the same seeds.
"""

import json
import math
import os
import statistics
import sys
import warnings
from pathlib import Path

import niwaki
from niwaki.gallery.spaceship import spaceship
from niwaki.search import SearchWarning

TEN = 10
STEPS = range(1, 200)
#: Name and settings.
WEIGHTINGS = {
    "absolute": {"weights": "absolute"},
    "ratio, 4": {"power": 4.0},
    "ratio, 8": {"power": 8.0},
    "ratio, 16": {"power": 16.0},
    "ratio, 64": {"power": 64.0},
    "ratio, 8, when half are effective": {"power": 8.0, "ess": 0.5},
    "ratio, 8, residual": {"power": 8.0, "resampling": "residual"},
    "ratio, half a step a barrier to 8": {"power": 8.0, "anneal": [min(8.0, 0.5 * k) for k in STEPS]},
    "ratio, 1 and half a step to 8": {"power": 8.0, "anneal": [min(8.0, 1 + 0.5 * k) for k in STEPS]},
    "ratio, 2 and a fifth of a step to 8": {"power": 8.0, "anneal": [min(8.0, 2 + 0.2 * k) for k in STEPS]},
    "ratio, adapted to 16 at 2 %": {"power": 16.0, "anneal": 0.02},
    "ratio, adapted to 16 at 20 %": {"power": 16.0, "anneal": 0.2},
}


def spread(values: list[float]) -> list[float]:
    """Mean and standard error."""
    return [statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values))]


def main(blocks: int = 6, *sizes: int) -> int:
    """Measure and print one line for each weighting and size."""
    named = os.environ.get("NIWAKI_REFERENCE_TARGETS")
    if not named:
        print("skipped: NIWAKI_REFERENCE_TARGETS names no folder of reference meshes")
        return 0
    warnings.simplefilter("ignore", SearchWarning)
    ship = niwaki.Target.load(Path(named) / "shipProxy2.obj")
    for particles in sizes or (10, 30, 100, 300, 1000):
        for name, settings in WEIGHTINGS.items():
            common = {
                "voxel": 0.25,
                "sigma": 0.02,
                "rule": "surface",
                "threads": 1,
                "particles": particles,
            }
            result = niwaki.grow(spaceship, ship, runs=TEN * blocks, seed=1, **common, **settings)
            scores = [sample.log_score for sample in result]
            worst = [min(scores[at : at + TEN]) for at in range(0, len(scores) - TEN + 1, TEN)]
            cpu = statistics.median(sample.cpu_seconds for sample in result)
            row = {"particles": particles, "weighting": name, "runs": len(scores), "mean": spread(scores)}
            print(json.dumps(row | {"worst of ten": spread(worst), "cpu": cpu}), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
