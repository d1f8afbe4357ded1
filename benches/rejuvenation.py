"""Distinct results on the gnarly tree: the effect of moves, final chains, particle Gibbs and separate populations.

    .venv/bin/python benches/rejuvenation.py [SEEDS FIRST [METHOD ...]]

The tree in the bent tube, voxel 0.4, sigma 0.02, one thread. Each method gives 100 results. The means of

- `distinct`: results of which no other shares more than half of its (address, value) pairs, which is what
  `Result.unique_models` counts,
- `apart`: the same where values count as shared when they are within a tenth of their spread over all results of the
  method: a small step of everything makes no visibly different tree,
- the best log score of all, and CPU seconds,

then, for each pair of a method that moves and one that does not: the differences of their best scores for the same
seeds, and the ratio of their CPU times. The manual's numbers are of seeds 1 to 20; settings were chosen on seeds from
101 on.
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
from niwaki.search import SearchWarning

N = 100
POWER = 16.0


def smc(particles: int = N, **settings: Any) -> Any:
    """A population at the power of `grow`."""
    return niwaki.smc(particles, power=POWER, **settings)


def moving(kernel: Any, moves: int, at: Any, **settings: Any) -> Any:
    """Return the estimate with moves."""
    return smc(rejuvenate=kernel, moves=moves, at=at, **settings)


def drifts() -> Any:
    """One choice at a time: small and large steps, and values from the prior."""
    return kernels.mixture(kernels.drift(0.3), kernels.drift(0.05), kernels.prior(), weights=[4, 2, 1])


def shake(step: float) -> Any:
    """Every real choice of the tree moves a little at once; its coins stay."""
    return kernels.on(["yaw", "pitch", "length", "end", "angle", "thick"], kernels.block(step, 1.0))


def chain_of_final_set(particles: int) -> Any:
    """One of the final set followed to a hundred results: twenty moves of one choice and two shakes between each."""
    kernel = kernels.cycle(kernels.repeat(20, kernels.prior()), kernels.repeat(2, shake(0.0005)))
    return smc(particles, rejuvenate=kernel, moves=22, at="end", draws=N)


METHODS = {
    "plain": lambda: smc(),
    "plain, 700": lambda: smc(700),
    "plain, 2500": lambda: smc(2500),
    "shaken at the end, 4": lambda: moving(shake(0.003), 4, "end"),
    "shaken at the end, 40": lambda: moving(shake(0.01), 40, "end"),
    "moved at the end, 300": lambda: moving(drifts(), 300, "end"),
    "moved at each barrier, 1": lambda: moving(drifts(), 1, 1),
    "populations of 10, diverse": lambda: smc(10, diverse=100),
    "final chain, 100": lambda: chain_of_final_set(100),
    "final chain, 300": lambda: chain_of_final_set(300),
    "particle Gibbs, 10": lambda: niwaki.particle_gibbs(10, N, power=POWER),
}


def shared(runs: list[dict[str, Any]], close: dict[str, float]) -> int:
    """How many runs there are of which no other has most choices, up to what is close."""

    def is_same(address: str, a: Any, b: Any) -> bool:
        return abs(a - b) <= close[address] if isinstance(a, float) else bool(a == b)

    def has_most(b: dict[str, Any], a: dict[str, Any]) -> bool:
        common = sum(address in b and is_same(address, value, b[address]) for address, value in a.items())
        return 2 * common > len(a)

    return sum(not any(other is not run and has_most(other, run) for other in runs) for run in runs)


def apart(result: Any) -> int:
    """Distinct results where close values count as shared."""
    runs = [dict(sample.choices) for sample in result]
    differences: dict[str, list[float]] = {}
    for run in runs:
        for address, value in run.items():
            if isinstance(value, float):
                differences.setdefault(address.rsplit("/", 1)[-1], []).append(value)
    spread = {name: 0.1 * statistics.pstdev(values) for name, values in differences.items()}
    return shared(
        runs, {address: spread.get(address.rsplit("/", 1)[-1], 0.0) for run in runs for address in run}
    )


def searched(name: str, score: Any, seed: int, looks_apart: bool) -> dict[str, Any] | None:
    """The result of one search; None where all particles became impossible."""
    began = time.process_time()
    try:
        result = niwaki.run(gnarly_tree, method=METHODS[name](), score=score, seed=seed, threads=1)
    except niwaki.InputError as error:
        if error.code != "everything-impossible":
            raise
        return None
    row: dict[str, Any] = {"cpu": time.process_time() - began, "best": result.best.log_score}
    result.samples = result.samples[:N]
    row |= {
        "distinct": result.unique_models or 0,
        "moved": (result.info.moved_running, result.info.moved_ended),
    }
    return row | ({"apart": apart(result)} if looks_apart else {})


def paired(ours: list[dict[str, Any] | None], plain: list[dict[str, Any] | None]) -> dict[str, Any]:
    """Differences of best scores, seed by seed: mean with a 95 % interval (Student's t), median, how often above."""
    both = [(a, b) for a, b in zip(ours, plain, strict=True) if a is not None and b is not None]
    steps = [a["best"] - b["best"] for a, b in both]
    mean, median = statistics.fmean(steps), statistics.median(steps)
    record: dict[str, Any] = {"mean": round(mean, 2), "median": round(median, 2)}
    if len(steps) > 1:
        # The 97.5 % quantile of Student's t, to a hundredth above 8 degrees of freedom (Abramowitz & Stegun 26.7.5).
        z, free = 1.959964, len(steps) - 1
        t = z + (z**3 + z) / (4 * free) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * free**2)
        half = t * statistics.stdev(steps) / math.sqrt(len(steps))
        record["95 %"] = [round(mean - half, 2), round(mean + half, 2)]
    record["above"] = f"{sum(step > 0.0 for step in steps)} of {len(steps)}"
    cpu = statistics.fmean(a["cpu"] for a, _ in both) / statistics.fmean(b["cpu"] for _, b in both)
    return record | {"CPU, times": round(cpu, 2)}


def main(seeds: int = 20, first: int = 1, *names: str) -> int:
    """Measure the methods in turn; print a line for each method, and for each with each plain method."""
    warnings.simplefilter("ignore", SearchWarning)
    score = niwaki.no_self_intersection() * niwaki.match_volume(
        named_target("bent_tube"), voxel=0.4, sigma=0.02
    )
    methods = names or tuple(METHODS)
    records: dict[str, list[dict[str, Any] | None]] = {name: [] for name in methods}
    for seed in range(first, first + seeds):
        for name in methods:
            records[name].append(searched(name, score, seed, seed < first + 3))
    for name, every in records.items():
        rows = [row for row in every if row is not None]
        record: dict[str, Any] = {
            "method": name,
            "seeds": [first, first + seeds - 1],
            "died": seeds - len(rows),
        }
        for key in ("distinct", "apart", "best", "cpu"):
            values = [row[key] for row in rows if key in row]
            record[key] = round(statistics.fmean(values), 3) if values else None
        record |= {"least distinct": min(row["distinct"] for row in rows)}
        record |= {"worst best": round(min(row["best"] for row in rows), 2)}
        moved = [row["moved"] for row in rows if row["moved"] is not None]
        for place, kind in enumerate(("running", "ended")):
            moves, kept = (sum(pairs[place][k] for pairs in moved) for k in (0, 1))
            if moves:
                record[f"moves kept, {kind}"] = f"{kept} of {moves}"
        print(json.dumps(record), flush=True)
    for name in methods:
        for other in methods:
            if other.startswith("plain") and not name.startswith("plain"):
                print(
                    json.dumps({"method": name, "less": other} | paired(records[name], records[other])),
                    flush=True,
                )
    return 0


if __name__ == "__main__":
    numbers = [int(word) for word in sys.argv[1:3]]
    sys.exit(main(*(numbers or [20, 1]), *sys.argv[3:]))
