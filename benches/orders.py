"""Orders of futures on the programs of dissertation chapter 5: learned, uniform and depth first, beside each other.

    python benches/orders.py [SEEDS [PARTICLES]]

For each program and its target (those of figure 5.9): an order is learned from searches with PARTICLES particles at
power 16 (`nw.grow`'s own sharpness), then each order searches by SEEDS seeds that no training had, on one thread. The
mean best log score and the mean log normalising constant with standard errors, how many searches died, and CPU seconds
of a search; and the differences of learned to uniform, seed by seed. Uniform orders with 1.5 times the particles show
what the time would buy otherwise. One JSON line for each program follows, with the numbers of its order.
"""

import json
import math
import statistics
import sys
import time
import warnings

import niwaki as nw
from figures_sosmc.comparison import CASES, score_of
from niwaki.gallery import entry, named_target
from niwaki.guides import train_order
from niwaki.search import SearchWarning

POWER = 16.0


def spread(values: list[float]) -> tuple[float, float]:
    """Mean and standard error."""
    return statistics.fmean(values), statistics.stdev(values) / math.sqrt(len(values))


def searched(search: nw.Search) -> tuple[float, float, float] | None:
    """Best log score, log normalising constant and CPU seconds of a search; nothing where it died."""
    start = time.process_time()
    try:
        result = search.run(threads=1)
    except nw.InputError as error:
        if error.code != "everything-impossible":
            raise
        return None
    return result.best.log_score, result.info.log_normaliser, time.process_time() - start


def main(seeds: int = 40, particles: int = 100) -> int:
    """Measure and print one line for each program and order."""
    warnings.simplefilter("ignore", SearchWarning)
    print("| program | order | particles | best log score | log constant | died | CPU, s |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, voxel, target, _ in CASES:
        model = entry(name).model
        base = nw.Search(model, score=score_of(named_target(target), voxel))
        method = nw.smc(particles, power=POWER)
        start = time.process_time()
        training = train_order(model, [base], method=method, seed=1)
        took = time.process_time() - start
        orders = {
            "uniform": (nw.smc(particles, power=POWER), []),
            "learned": (nw.smc(particles, power=POWER, order=training.rounds[-1]), []),
            "depth first": (nw.smc(particles, power=POWER, order="depth-first"), []),
            "uniform, 1.5 times": (nw.smc(particles * 3 // 2, power=POWER), []),
        }
        # Methods take turns, so that a busy machine is busy for all of them.
        for seed in range(1000, 1000 + seeds):
            for order_of_name, ends in orders.values():
                ends.append(searched(nw.Search(model, score=base.score, method=order_of_name, seed=seed)))
        for order, (order_of_name, ends) in orders.items():
            lived = [end for end in ends if end is not None]
            best, constant, cpu = (spread([end[i] for end in lived]) for i in range(3))
            print(
                f"| {name} | {order} | {order_of_name.particles} | {best[0]:.1f} ({best[1]:.1f}) "
                f"| {constant[0]:.0f} ({constant[1]:.0f}) | {len(ends) - len(lived)} | {cpu[0]:.3f} |",
                flush=True,
            )
        both = zip(orders["learned"][1], orders["uniform"][1], strict=True)
        pairs = [(a, b) for a, b in both if a is not None and b is not None]
        by = [spread([a[i] - b[i] for a, b in pairs]) for i in range(2)]
        row = {
            "program": name,
            "best by": by[0],
            "constant by": by[1],
            "training": took,
            "order": training.rounds[-1].data(),
            "judged": [training.learned, training.uniform, training.error, training.died],
        }
        print(json.dumps(row), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
