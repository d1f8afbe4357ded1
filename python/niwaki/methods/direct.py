"""Methods that need no chain and no population: forward runs, enumeration, rejection, likelihood weighting."""

from __future__ import annotations

from dataclasses import InitVar, dataclass

from niwaki.methods.checks import with_guide
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class EnumerateAll(Method):
    """Exact distribution of a model's value, by a visit of every run; an error if no run is possible.

    With `likely` only a part of the runs is visited, the likeliest first, and a whole number may be unbounded.
    `Result.info` then bounds the probability of the other runs.

    Parameters
    ----------
    max_runs
        The most runs to visit, with impossible ones. More runs are an error, unless `likely` is set.
    likely
        Whether to stop after `max_runs`; the branch with the largest joint probability so far is visited first.
    rest
        The most that the rest of a run can add to its log score, nats: 0 if each factor is at most 0 and each
        observation is of a whole number or a truth value. Only the bounds depend on it.
    """

    NAME = "enumerate_all"
    max_runs: int = 1_000_000
    likely: bool = False
    rest: float = 0.0

    def __post_init__(self) -> None:
        """Check the settings."""
        self._set("likely", bool(self.likely))
        self._set("rest", as_real(self.rest))
        self._check()


@dataclass(frozen=True)
class Rejection(Method):
    """Exact samples: forward runs, accepted with probability `exp(log_score - bound)`.

    Parameters
    ----------
    n
        The number of samples.
    bound
        A log score that no run exceeds, nats; 0 for models with conditions only.
    max_tries
        The most runs to draw.
    """

    NAME = "rejection"
    n: int = 100
    bound: float = 0.0
    max_tries: int = 1_000_000

    def __post_init__(self) -> None:
        """Check the settings."""
        self._set("bound", as_real(self.bound))
        self._check()


@dataclass(frozen=True)
class Importance(Method):
    """Independent forward runs, each weighted by its score; an error if all are impossible.

    Parameters
    ----------
    n
        The number of runs.
    proposal
        The proposal that draws choices in place of the prior: `kernels.on(pattern, kernels.proposal(function))`, or a
        `cycle` of several. The first pattern that matches a choice decides. The weights correct for the proposal, so
        the distribution and the evidence stay the same.
    guide
        The guide that draws all other choices that it knows; the weights correct for it, too.
    """

    NAME = "importance"
    n: int = 1000
    proposal: Kernel | None = None
    guide: InitVar[Guide | None] = None

    def __post_init__(self, guide: Guide | None) -> None:
        """Check the settings."""
        self._set("proposal", with_guide(self.proposal, guide))
        self._check()


@dataclass(frozen=True)
class Forward(Method):
    """Runs of the prior: every choice is drawn from its distribution, whatever the score.

    Parameters
    ----------
    n
        The number of runs.
    """

    NAME = "forward"
    n: int = 1

    def __post_init__(self) -> None:
        """Check the settings."""
        self._check()


enumerate_all, rejection, importance, forward = EnumerateAll, Rejection, Importance, Forward
