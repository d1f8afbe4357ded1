"""Figures 3.4 and 3.5 of the dissertation and the speedup figure after them, drawn again.

Each point is the mean of 20 runs with the 95 % interval of that mean in a lighter shade. Times are CPU seconds
of one thread. As in the dissertation, chains are shown from their first state on.
"""

import statistics
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from figures import colors
from models import hmm_forms
from niwaki.gallery.lda import lda

from chains.answers import spread
from chains.ours import Timed
from chains.programs import PROGRAMS
from chains.report import Report
from chains.tree import SMALLEST, Measured

NAMES = {"rerun": "rerun", "resume": "resume", "cache": "cache", "c3": "C3"}
SIZES = tuple(range(1, 11))
Series = dict[str, dict[int, list[float]]]


def seconds_of(model: object, count: int, strategy: str, seed: int, steps: int, **more: object) -> float:
    """CPU seconds of a chain's first proposals."""
    chain = Timed(model, count, strategy=strategy, seed=seed, **more)  # type: ignore[arg-type]
    return max(chain.seconds(steps) - chain.floor, 1e-9)


#: Panels of figure 3.4: model, its name, what is counted, by how many, proposals.
ROWS = (
    (hmm_forms.returned_list, "hidden Markov model", "steps", 10, 10_000),
    (lda, "topics", "documents", 5, 1000),
)


def four_strategies(path: Path, report: Report, runs: int) -> None:
    """Figure 3.4: an HMM of 10 to 100 steps, 10,000 proposals; LDA of 5 to 50 documents, 1000 proposals."""
    measured = []
    for model, title, _, unit, steps in ROWS:
        series: Series = {strategy: {unit * size: [] for size in SIZES} for strategy in NAMES}
        for size in SIZES:
            for seed in range(runs):
                for strategy in NAMES:
                    spent = seconds_of(model, unit * size, strategy, seed, steps)
                    series[strategy][unit * size].append(spent)
        report.note(figure="3.4", model=title, seconds=series)
        measured.append(series)
    draw_strategies(path, measured, runs)


def draw_strategies(path: Path, measured: list[Series], runs: int) -> None:
    """Seconds and proposals per second of both models."""
    figure, panels = plt.subplots(2, 2, figsize=(9, 6.4), layout="constrained")
    for row, series, (_, title, label, _, steps) in zip(panels, measured, ROWS, strict=True):
        rates: Series = {
            strategy: {
                size: [steps / run_steps for run_steps in all_runs] for size, all_runs in points.items()
            }
            for strategy, points in series.items()
        }
        curves(row[0], series)
        curves(row[1], rates)
        row[0].set(ylabel=f"seconds, {steps:,} proposals", xlabel=label, title=title, yscale="log")
        row[1].set(ylabel="proposals per second", xlabel=label, title=title, yscale="log")
    panels[0, 0].legend(frameon=False, ncols=2)
    save(figure, path, runs)


def curves(panel: plt.Axes, series: Series) -> None:
    """Means with their 95 % intervals."""
    for color, (strategy, points) in zip(colors(), series.items(), strict=False):
        sizes = np.array(sorted(points))
        means = np.array([statistics.fmean(points[size]) for size in sizes])
        half = np.array([spread(points[size]) for size in sizes])
        panel.plot(sizes, means, color=color, label=NAMES.get(strategy, strategy), linewidth=1.6)
        low = np.maximum(means - half, means * 0.01)
        panel.fill_between(sizes, low, means + half, color=color, alpha=0.22, linewidth=0)
    panel.grid(alpha=0.3, which="both", linewidth=0.5)


def speedups(path: Path, report: Report, runs: int, steps: int = 1000) -> None:
    """Speedup of C3 over rerun on the four programs at sizes 1 to 10."""
    series: Series = {name: {size: [] for size in SIZES} for name in PROGRAMS}
    for name, program in PROGRAMS.items():
        for size in SIZES:
            count = program.count(size)
            for seed in range(runs):
                rerun, c3 = (
                    seconds_of(program.model, count, strategy, seed, steps, kernel=program.kernel(count))
                    for strategy in ("rerun", "c3")
                )
                series[name][size].append(rerun / c3)
    report.note(figure="speedup", speedup=series)
    draw_speedups(path, series, runs)


def draw_speedups(path: Path, series: Series, runs: int) -> None:
    """One curve for each program."""
    figure, panel = plt.subplots(figsize=(6, 4), layout="constrained")
    curves(panel, {name.upper(): points for name, points in series.items()})
    panel.set(xlabel="model size", ylabel="C3 over rerun", yscale="log")
    panel.legend(frameon=False, ncols=2)
    save(figure, path, runs)


def tree(path: Path, rows_of_all: list[Measured], target: object, fit: object) -> None:
    """Figure 3.5: the tube, a tree that chains found for it, and proposals per second of the four strategies."""
    figure = plt.figure(figsize=(10, 4.2), layout="constrained")
    left, middle, right = figure.subplots(1, 3, width_ratios=(0.62, 0.62, 1.4))
    for panel, image, title in ((left, target, "target"), (middle, fit, "result")):
        panel.imshow(image)
        panel.set(title=title, xticks=[], yticks=[])
        panel.spines[:].set_visible(False)
    names = list(NAMES)
    for number, (smallest, color) in enumerate(zip(SMALLEST, colors(), strict=False)):
        rows = [row for row in rows_of_all if row.smallest == smallest]
        rates = [[row.rates[name] for row in rows] for name in names]
        where = np.arange(len(names)) + (number - 1) * 0.25
        error = [spread(row) for row in rates] if len(rows) > 1 else None
        count = statistics.fmean(row.segments for row in rows)
        means = [statistics.fmean(row) for row in rates]
        right.bar(
            where,
            means,
            0.23,
            yerr=error,
            color=color,
            label=f"{count:.0f} segments",
            error_kw={"elinewidth": 1},
        )
    right.set(xticks=range(len(names)), xticklabels=[NAMES[name] for name in names], yscale="log")
    right.set(ylabel="proposals per second")
    right.legend(frameon=False, loc="upper left")
    right.grid(alpha=0.3, axis="y", which="both", linewidth=0.5)
    save(figure, path, len(rows_of_all) // len(SMALLEST))


def save(figure: plt.Figure, path: Path, runs: int) -> None:
    """Write it, with how many runs it shows in its corner."""
    figure.get_layout_engine().set(rect=(0.0, 0.025, 1.0, 0.975))
    figure.text(0.995, 0.006, f"mean of {runs} runs, 95 % bounds", ha="right", fontsize=7, color="#666666")
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=110)
    plt.close(figure)
