"""What a round of training did: for people who watch it, and in the report of the guide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

#: A similarity below is that of a stump: a run that ended before it covered anything.
STUMP = 0.1


@dataclass(frozen=True)
class Round:
    """A round of training; given to `progress` as it goes on.

    Attributes
    ----------
    number, rounds : int
        Which round, from 0, of how many.
    traces, wanted : int
        Searches that gave a trace so far, and searches in all.
    failed : int
        Searches whose every run was impossible, ended by a fault, or was no better than an empty scene.
    step, steps : int
        Steps of training so far, and in all; 0 until it begins.
    losses : list of (int, float, float)
        Steps, mean loss of the choices learned from, and of those held out, nats for each choice.
    bounds : list of (int, float, float)
        Where a bound is raised: steps, its mean over the runs since the line before, and over runs of the held-out
        targets, nats.
    lost : list of (int, int)
        Of each of these: runs since the line before that were impossible, and those that a fault ended.
    scores : list of float
        Log scores of the held-out targets, by a search with few particles.
    similarities : list of float
        Their similarities, where the score has one.
    """

    number: int
    rounds: int = 1
    traces: int = 0
    wanted: int = 0
    failed: int = 0
    step: int = 0
    steps: int = 0
    losses: list[tuple[int, float, float]] = field(default_factory=list)
    bounds: list[tuple[int, float, float]] = field(default_factory=list)
    lost: list[tuple[int, int]] = field(default_factory=list)
    scores: list[float] = field(default_factory=list)
    similarities: list[float] = field(default_factory=list)

    @property
    def is_judged(self) -> bool:
        """Whether the round is over."""
        return bool(self.scores)

    @property
    def has_learned(self) -> bool:
        """Whether a step of training was looked at."""
        return any(looks and looks[-1][0] > 0 for looks in (self.losses, self.bounds))

    def summary(self) -> dict[str, float]:
        """Mean, median and worst tenth of the similarities, and the share of stumps; or of the log scores."""
        return summary(self.similarities) if self.similarities else spread(self.scores)

    def data(self) -> dict[str, Any]:
        """As plain data, for the guide's report."""
        names = ["number", "traces", "wanted", "failed", "losses", "scores", "similarities"]
        if self.bounds:
            names += ["bounds", "lost"]
        own = asdict(self)
        return {**{name: own[name] for name in names}, "summary": self.summary()}


def summary(similarities: Sequence[float]) -> dict[str, float]:
    """Mean, median and worst tenth of similarities, and the share of stumps."""
    stumps = float(np.mean(np.asarray(similarities) < STUMP))
    return {**spread(similarities), "stumps": stumps}


def spread(values: Sequence[float]) -> dict[str, float]:
    """Mean, median, and the value that a tenth do not reach."""
    if not values:
        return {}
    numbers = np.asarray(values, dtype=np.float64)
    worst = float(np.quantile(numbers, 0.1))
    return {"mean": float(numbers.mean()), "median": float(np.median(numbers)), "p10": worst}


def sentence(numbers: dict[str, float]) -> str:
    """A summary as text."""
    names = {"mean": "mean", "median": "median", "p10": "worst tenth", "stumps": "stumps"}
    shown = [
        f"{names[name]} {value:.0%}" if name == "stumps" else f"{names[name]} {value:.3f}"
        for name, value in numbers.items()
    ]
    return ", ".join(shown)
