"""What is said of a result that is worth less than its search promised."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.errors.warned import warn
from niwaki.methods.kernels import Kernel
from niwaki.result import Sample
from niwaki.targets.sketches import Score
from niwaki.targets.target import Target

#: A scene this many times as long as its target, or the other way round, has another unit.
SIZES = 10.0


class SearchWarning(UserWarning):
    """A search gave a result, but one that is worth less than its settings promise."""


def check_worth(task: _engine.Task, score: Score, best: Sample) -> None:
    """Warn where the best is no better than nothing, has another size than its target, or is far from it."""
    found = [_gain(task, best)]
    if score.target is not None and best.primitives:
        found += [_size(score.target, best.scene), _distance(score.target, best)]
    for text in filter(None, found):
        warn(text, SearchWarning)


def check_kinds(task: _engine.Task, seed: int) -> None:
    """Warn where an observation is a probability in some runs and a density in others: no weight compares these."""
    found = task.mixed(seed)
    if found is None:
        return
    (path, line), (other, density) = found
    first, second = f"{Path(path).name}:{line}", f"{Path(other).name}:{density}"
    where = f"at {first} has" if first == second else f"has (at {first})"
    there = "" if first == second else f" (at {second})"
    warn(
        f"an observation {where} the probability of a single value in some runs, and in others a density{there}. "
        "Their weights cannot be compared: in other units the results would be others. Observe it by a density in all "
        "runs, with a narrow `Gaussian` in place of a single value, or by a discrete distribution in all runs",
        SearchWarning,
    )


def check_reach(task: _engine.Task, kernel: Kernel | None, seed: int) -> None:
    """Warn where a kernel alone cannot lead a chain to every run: results would depend on where the chain starts."""
    leaves = [] if kernel is None else [leaf.first("regrow") for leaf in kernel.leaves()]
    if not leaves or not all(_grows_choices(leaf) for leaf in leaves) or not task.is_apart(seed):
        return
    warn(
        '`kernels.regrow(pick="choice")` alone does not reach all runs of this model: which parts there are depends on '
        'choices in other parts, and a chain keeps those of its first run. Use `pick="size"`, or add a kernel such as '
        "`kernels.prior()` by `kernels.cycle`",
        SearchWarning,
    )


def _grows_choices(leaf: Kernel | None) -> bool:
    return leaf is not None and leaf.settings.get("pick") == "choice"


def _gain(task: _engine.Task, best: Sample) -> str:
    gain = task.gain(best._run)
    if gain > 0.0 or (gain == 0.0 and best.primitives):
        return ""
    than = f"scores {-gain:.1f} nats less than" if gain < 0.0 else "is"
    return (
        f"the best result {than} an empty scene: give more `seconds` or `rounds`, or look whether the model can "
        "reach its target at all (`niwaki show MODEL`; `niwaki.run(model).best.save('scene.png')`)"
    )


def _size(target: Target, scene: Scene) -> str:
    own, wanted = float(scene.size.max()), float(target.size.max())
    if wanted / SIZES <= own <= wanted * SIZES:
        return ""
    times, small, large = (
        (own / wanted, "target", "model") if own > wanted else (wanted / own, "model", "target")
    )
    return (
        f"the {large} is {times:.0f} times as large as the {small}: {own:.3g} and the target {wanted:.3g} along the "
        "longest side, scene units. A mesh is taken as it is in its file: scale it there, or the model"
    )


def _distance(target: Target, best: Sample) -> str:
    first = Scene([best.parts[0]]).bounds
    low, high = target.bounds
    gap = np.maximum(np.maximum(first[0] - high, low - first[1]), 0.0)
    away = float(np.linalg.norm(gap))
    if away <= float(target.size.max()):
        return ""
    start, middle = ((bounds[0] + bounds[1]) / 2.0 for bounds in (first, target.bounds))
    return (
        f"the target is far from where the model begins: its first part is at {_point(start)}, {away:.3g} from the "
        f"target, whose middle is at {_point(middle)}. Move the mesh, or let the model begin there"
    )


def _point(place: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> str:
    return f"({', '.join(f'{part:.3g}' for part in place)})"
