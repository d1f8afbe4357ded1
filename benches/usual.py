"""The usual search beside the original's weights, search by search: the models and the targets of figure 5.9.

    .venv/bin/python benches/usual.py [PARTICLES:SEARCHES ...]

Sigma 0.02, the original's rule for intersections (`surface`), seeds from 1000 on, the same for all methods, one thread.
For each model and target, at each number of particles: mean, median and worst of the best log scores of the searches
that ended, how many became impossible, the mean difference to the original's weights with its standard error (of the
seeds that ended with both), and CPU milliseconds of one search.
"""

import math
import statistics
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent / "figures_sosmc"))

import niwaki as nw
from comparison import CASES, METHODS, meshes, score_of, searched
from niwaki.gallery import entry

SEED = 1000
ORIGINAL, OURS = "stochastic", "usual search"


def main(*sizes: str) -> int:
    """Measure and print one line for each target, size and method."""
    cases = [
        tuple(map(int, size.split(":")))
        for size in sizes or ("10:100", "30:60", "100:30", "300:12", "1000:4")
    ]
    for owner, targets in meshes().items():
        for (model, voxel, _, _), target in zip(CASES, targets, strict=True):
            program, score = entry(model).model, score_of(target, voxel)
            # The first run compiles.
            searched(program, score, nw.smc(2), 0)
            for particles, searches in cases:
                print_rows(f"{owner:<10}{model:<12}", program, score, particles, searches)
    return 0


def print_rows(head: str, program: nw.Model, score: nw.Score, particles: int, searches: int) -> None:
    """All methods at one number of particles."""
    names = (ORIGINAL, OURS)
    rows = [
        {name: searched(program, score, METHODS[name](particles), seed) for name in names}
        for seed in range(SEED, SEED + searches)
    ]
    for method in names:
        ended = [row[method][0] for row in rows if row[method][0] is not None]
        less = [
            row[method][0] - row[ORIGINAL][0]
            for row in rows
            if row[method][0] is not None and row[ORIGINAL][0] is not None
        ]
        error = statistics.stdev(less) / math.sqrt(len(less))
        cpu = 1000.0 * statistics.fmean(row[method][1] for row in rows)
        middle, died = statistics.median(ended), searches - len(ended)
        print(
            f"{head}{particles:>5} {method:<16} mean {statistics.fmean(ended):7.2f}  median {middle:7.2f}"
            f"  worst {min(ended):8.2f}  died {died:>2} of {searches}"
            f"  {statistics.fmean(less):+6.2f} ({error:.2f})  {cpu:6.1f} ms",
            flush=True,
        )


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
