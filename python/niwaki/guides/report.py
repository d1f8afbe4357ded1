"""The results of a round of training, for its progress and for the report of the guide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from niwaki.shares import percent

#: A run with a lower similarity is a stump: it ended before it covered anything.
STUMP = 0.1


@dataclass(frozen=True)
class Round:
    """A round of training, as `progress` gets it.

    Attributes
    ----------
    number, rounds : int
        Number of the round, from 0, and of all rounds.
    traces, wanted : int
        Number of searches that gave a trace so far, and of all searches.
    failed : int
        Number of searches in which each run was impossible, ended with a fault, or was no better than an empty scene.
    step, steps : int
        Number of training steps so far, and of all steps; 0 before training starts.
    losses : list of (int, float, float)
        Rows of the number of steps, and the mean loss of training and of held-out choices, in nats for each choice.
    bounds : list of (int, float, float)
        For the bounds: rows of the number of steps, the mean bound over the runs since the last row, and over runs of
        the held-out targets, in nats.
    lost : list of (int, int)
        For each row of `bounds`: runs since the last row that were impossible, and that ended with a fault.
    scores : list of float
        Log scores of the held-out targets, from a search with few particles.
    similarities : list of float
        Similarities of the held-out targets, if the score has a similarity.
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
        """Whether the round is complete."""
        return bool(self.scores)

    @property
    def has_learned(self) -> bool:
        """Whether the losses or bounds have a row after the first step."""
        return any(looks and looks[-1][0] > 0 for looks in (self.losses, self.bounds))

    def summary(self) -> dict[str, float]:
        """Return mean, median and worst tenth of the similarities, and the share of stumps; or else of the scores."""
        return summary(self.similarities) if self.similarities else spread(self.scores)

    def data(self) -> dict[str, Any]:
        """Return the round as plain data, for the guide's report."""
        names = ["number", "traces", "wanted", "failed", "losses", "scores", "similarities"]
        if self.bounds:
            names += ["bounds", "lost"]
        values = asdict(self)
        return {**{name: values[name] for name in names}, "summary": self.summary()}


def summary(similarities: Sequence[float]) -> dict[str, float]:
    """Return mean, median and worst tenth of similarities, and the share of stumps."""
    stumps = float(np.mean(np.asarray(similarities) < STUMP))
    return {**spread(similarities), "stumps": stumps}


def spread(values: Sequence[float]) -> dict[str, float]:
    """Return mean, median and the worst tenth, which is the 10 % quantile."""
    if not values:
        return {}
    numbers = np.asarray(values, dtype=np.float64)
    worst = float(np.quantile(numbers, 0.1))
    return {"mean": float(numbers.mean()), "median": float(np.median(numbers)), "p10": worst}


def sentence(numbers: dict[str, float]) -> str:
    """Return a summary as text."""
    names = {"mean": "mean", "median": "median", "p10": "worst tenth", "stumps": "stumps"}
    shown = [
        f"{names[name]} {percent(value)}" if name == "stumps" else f"{names[name]} {value:.3f}"
        for name, value in numbers.items()
    ]
    return ", ".join(shown)
