"""What we recommend beside the original's weights, search by search: the models and the targets of figure 5.9.

    .venv/bin/python benches/recommended.py [PARTICLES:SEARCHES ...]

Sigma 0.02, the original's rule for intersections (`surface`), seeds from 1000 on, the same for all ways, one thread.
For each model and target, at each number of particles: mean, median and worst of the best log scores of the searches
that lived, how many died, the mean difference to the original's weights with its standard error (of the seeds that
lived both ways), and CPU milliseconds of one search. `without a chain` stops where the population ends.
"""

import math
import statistics
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent / "figures_sosmc"))

import niwaki as nw
from comparison import CASES, WAYS, meshes, onward, score_of, searched
from niwaki.gallery import entry

SEED = 1000
ORIGINAL, OURS, ALONE = "stochastic", "recommended", "without a chain"


def main(*sizes: str) -> int:
    """Measure and print one line for each target, size and way."""
    asked = [
        tuple(map(int, size.split(":")))
        for size in sizes or ("10:100", "30:60", "100:30", "300:12", "1000:4")
    ]
    for whose, targets in meshes().items():
        for (model, voxel, _, _), target in zip(CASES, targets, strict=True):
            program, score = entry(model).model, score_of(target, voxel)
            # The first run compiles.
            searched(program, score, 2, {}, 0)
            for particles, searches in asked:
                print_rows(f"{whose:<10}{model:<12}", program, score, particles, searches)
    return 0


def print_rows(head: str, program: nw.Model, score: nw.Score, particles: int, searches: int) -> None:
    """All ways at one number of particles."""
    chain = onward(program, particles)
    ways = {
        ORIGINAL: (WAYS[ORIGINAL], None),
        ALONE: (WAYS[OURS], None),
        OURS: (WAYS[OURS], chain),
    }
    rows = [
        {
            way: searched(program, score, particles, settings, seed, more)
            for way, (settings, more) in ways.items()
        }
        for seed in range(SEED, SEED + searches)
    ]
    for way in ways:
        lived = [row[way][0] for row in rows if row[way][0] is not None]
        less = [
            row[way][0] - row[ORIGINAL][0]
            for row in rows
            if row[way][0] is not None and row[ORIGINAL][0] is not None
        ]
        error = statistics.stdev(less) / math.sqrt(len(less))
        cpu = 1000.0 * statistics.fmean(row[way][1] for row in rows)
        middle, died = statistics.median(lived), searches - len(lived)
        print(
            f"{head}{particles:>5} {way:<16} mean {statistics.fmean(lived):7.2f}  median {middle:7.2f}"
            f"  worst {min(lived):8.2f}  died {died:>2} of {searches}"
            f"  {statistics.fmean(less):+6.2f} ({error:.2f})  {cpu:6.1f} ms",
            flush=True,
        )


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
