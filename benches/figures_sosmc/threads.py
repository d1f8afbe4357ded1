"""The time that a second thread saves: wall seconds of experiments of chapter 5 on one thread and on two.

The original's settings and particles, on our own targets. A seed is searched in turn on one thread and on two, several
times over, and the least of each counts: other programs can only add to it. Results must be the same to the bit.
"""

from collections.abc import Callable
from pathlib import Path

from experiments import Experiment, experiment

NAMES = ("tree", "digits-of-pipes", "face-of-blocks", "ship", "building")
SEEDS, REPEATS = (1, 2, 3), 7
THREADS = (1, 2)
#: Wall seconds with two threads at most, as a share of those with one.
MOST = 0.6


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Measure and print; the folder gets no picture of its own."""
    print(f"{'experiment':<18}{'particles':>10}{'1 thread, s':>13}{'2 threads, s':>14}{'share':>7}")
    shares = []
    for example in map(experiment, NAMES):
        wall = [0.0, 0.0]
        for seed in SEEDS[: 1 if quick else None]:
            least = fastest(example, seed, 1 if quick else REPEATS)
            wall = [sum(pair) for pair in zip(wall, least, strict=True)]
        shares.append(wall[1] / wall[0])
        tell(
            {"experiment": example.name, "particles": example.particles, "seconds": wall, "share": shares[-1]}
        )
        print(
            f"{example.name:<18}{example.particles:>10}{wall[0]:>13.3f}{wall[1]:>14.3f}{shares[-1]:>7.2f}",
            flush=True,
        )
    print(f"largest share: {max(shares):.2f}, target: at most {MOST}")


def fastest(example: Experiment, seed: int, repeats: int) -> list[float]:
    """Least wall seconds for each number of threads."""
    least = [float("inf")] * len(THREADS)
    times: list[list[float]] = []
    for _ in range(repeats):
        for i, threads in enumerate(THREADS):
            result = example.run("original", seed=seed, threads=threads)
            least[i] = min(least[i], result.seconds)
            times.append([sample.log_score for sample in result])
    assert all(scores == times[0] for scores in times), "threads changed what was found"
    return least
