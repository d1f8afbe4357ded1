"""Curves for what is measured: cost against primitives and particles.

    .venv/bin/python benches/figures.py MEASUREMENTS.jsonl FIGURE.png

Each line of the file is a JSON object for one run: `series` (a name), `particles`, `primitives` and
`cpu_seconds`.
Lines that share a series and a size become one point: the median, with a band from the 10th to the 90th
percentile.
"""

import json
import sys
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def cost(runs: list[dict], path: Path, dots_per_inch: int = 120) -> None:
    """Draw CPU seconds against particles and against primitives, both axes logarithmic.

    A series is in the panel of its variable: particles where it has several numbers of them, else
    primitives. A dotted line through the first point of each shows what growing in proportion would be.
    """
    numbers: dict[str, set[int]] = defaultdict(set)
    for run in runs:
        numbers[run["series"]].add(run["particles"])
    chosen = {
        "particles": [run for run in runs if len(numbers[run["series"]]) > 1],
        "primitives": [run for run in runs if len(numbers[run["series"]]) == 1],
    }
    labels = {"particles": "particles", "primitives": "primitives"}
    figure, panels = plt.subplots(1, len(labels), figsize=(10, 4), sharey=True, layout="constrained")
    for panel, (size, label) in zip(panels, labels.items(), strict=True):
        for color, (name, points) in zip(colors(), grouped(chosen[size], size).items(), strict=False):
            sizes = np.array(sorted(points))
            low, middle, high = np.array([np.percentile(points[s], (10, 50, 90)) for s in sizes]).T
            panel.plot(sizes, middle, "o-", color=color, label=name, markersize=4)
            panel.fill_between(sizes, low, high, color=color, alpha=0.2, linewidth=0)
            panel.plot(sizes, middle[0] * sizes / sizes[0], ":", color=color, linewidth=1)
        panel.set(xscale="log", yscale="log", xlabel=label)
        panel.grid(alpha=0.3)
        panel.legend(frameon=False)
    panels[0].set_ylabel("CPU seconds of a run")
    figure.savefig(path, dpi=dots_per_inch)
    plt.close(figure)


def grouped(runs: list[dict], size: str) -> dict[str, dict[int, list[float]]]:
    """Seconds by series and size, in the order of the file."""
    series: dict[str, dict[int, list[float]]] = defaultdict(lambda: defaultdict(list))
    for run in runs:
        series[run["series"]][run[size]].append(run["cpu_seconds"])
    return series


def colors() -> list[str]:
    """Colours for curves, darkest first, that people with red-green colour blindness can distinguish."""
    return ["#1b4965", "#ca6702", "#5a9a8f", "#9b2226", "#7a6c9c"]


if __name__ == "__main__":
    lines = Path(sys.argv[1]).read_text().splitlines()
    cost([json.loads(line) for line in lines if line], Path(sys.argv[2]))
