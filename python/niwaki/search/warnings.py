"""Warnings about poor results."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.errors.warned import warn
from niwaki.methods.kernels import Kernel
from niwaki.result import Sample
from niwaki.targets.sketches import Score
from niwaki.targets.target import Target

#: A scene and a target whose lengths differ by this factor are in different units.
SIZES = 10.0


class SearchWarning(UserWarning):
    """A search gave a result that is worse than its settings promise."""


def check_best(task: _engine.Task, score: Score, best: Sample) -> None:
    """Warn if the best sample is no better than an empty scene, differs from its target in size, or is far from it."""
    texts = [_gain(task, best)]
    if score.target is not None and best.primitives:
        texts += [_size(score.target, best.scene), _distance(score.target, best)]
    for text in filter(None, texts):
        warn(text, SearchWarning)


def check_observations(task: _engine.Task, seed: int) -> None:
    """Warn if an observation has a probability in some runs and a density in others: no weight compares these."""
    places = task.mixed(seed)
    if places is None:
        return
    (path, line), (density_path, density_line) = places
    first, second = f"{Path(path).name}:{line}", f"{Path(density_path).name}:{density_line}"
    where = f"at {first} has" if first == second else f"has (at {first})"
    there = "" if first == second else f" (at {second})"
    warn(
        f"an observation {where} the probability of a single value in some runs, and a density in other runs{there}. "
        "Their weights cannot be compared: the results depend on the units. Observe it by a density in all runs, with "
        "a narrow `Gaussian` in place of a single value, or by a discrete distribution in all runs",
        SearchWarning,
    )


def check_reach(task: _engine.Task, kernel: Kernel | None, seed: int) -> None:
    """Warn if a kernel cannot lead a chain to every run, because results then depend on where the chain starts."""
    leaves = [] if kernel is None else [leaf.first("regrow") for leaf in kernel.leaves()]
    if not leaves or not all(_grows_choices(leaf) for leaf in leaves) or not task.is_apart(seed):
        return
    warn(
        '`kernels.regrow(pick="choice")` alone does not reach all runs of this model. Choices in some parts decide '
        'which other parts exist, and a chain keeps the parts of its first run. Use `pick="size"`, or add a kernel '
        "such as `kernels.prior()` by `kernels.cycle`",
        SearchWarning,
    )


def _grows_choices(leaf: Kernel | None) -> bool:
    return leaf is not None and leaf.settings.get("pick") == "choice"


def times_as_large(length: float, goal: float) -> float | None:
    """Return how many times as large the larger of two lengths is; None if both can be of the same unit."""
    if goal / SIZES <= length <= goal * SIZES:
        return None
    return max(length / goal, goal / length)


def gap(first: NDArray[np.float64], second: NDArray[np.float64]) -> float:
    """Return the distance between two boxes, each given by its low and its high corner."""
    between = np.maximum(np.maximum(first[0] - second[1], second[0] - first[1]), 0.0)
    return float(np.linalg.norm(between))


def _gain(task: _engine.Task, best: Sample) -> str:
    gain = task.gain(best._run)
    if gain > 0.0 or (gain == 0.0 and best.primitives):
        return ""
    than = f"scores {-gain:.1f} nats less than" if gain < 0.0 else "is"
    return (
        f"the best result {than} an empty scene: give more `seconds` or `rounds`, or check that the model can "
        "reach its target (`niwaki show MODEL`; `niwaki.run(model).best.save('scene.png')`)"
    )


def _size(target: Target, scene: Scene) -> str:
    length, goal = float(scene.size.max()), float(target.size.max())
    times = times_as_large(length, goal)
    if times is None:
        return ""
    small, large = ("target", "model") if length > goal else ("model", "target")
    return (
        f"the {large} is {times:.0f} times as large as the {small}: the longest side of the model is {length:.3g} "
        f"scene units, that of the target {goal:.3g}. Scale the mesh in its file, or the model"
    )


def _distance(target: Target, best: Sample) -> str:
    first = Scene([best.parts[0]]).bounds
    away = gap(first, target.bounds)
    if away <= float(target.size.max()):
        return ""
    start, middle = ((bounds[0] + bounds[1]) / 2.0 for bounds in (first, target.bounds))
    return (
        f"the target is far from where the model begins: the first part of the model is at {_point(start)}, "
        f"{away:.3g} from the target, whose middle is at {_point(middle)}. Move the mesh, or begin the model there"
    )


def _point(place: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> str:
    return f"({', '.join(f'{part:.3g}' for part in place)})"
