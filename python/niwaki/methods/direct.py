"""Methods that need no chain and no population: forward runs, enumeration, rejection, likelihood weighting."""

from __future__ import annotations

from dataclasses import InitVar, dataclass

from niwaki.methods.checks import guided as with_guide
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class EnumerateAll(Method):
    """The exact distribution of a model's value, by visiting every run; an error where none is possible.

    With `likely` only a part of the runs is visited, the likeliest first, and a whole number may be unbounded.
    `Result.info` then bounds what was not seen.

    Parameters
    ----------
    max_runs
        Most runs to visit, those that prove impossible included. More are an error, unless `likely` is set.
    likely
        Stop after `max_runs`, each time going on with the branch whose joint probability so far is the largest.
    rest
        The most that the rest of a run can add to its log score, nats: 0 where each factor is at most 0 and each
        observation is of a whole number or a truth value. It decides the bounds alone.
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
    """Exact samples: forward runs, kept with probability `exp(log_score - bound)`.

    Parameters
    ----------
    n
        How many samples.
    bound
        A log score that no run exceeds, nats; 0 serves for conditions.
    max_tries
        Most runs to try.
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
    """Independent forward runs, each weighted by its score; an error where all are impossible.

    Parameters
    ----------
    n
        How many runs.
    proposal
        Who draws the choices that the prior does not: `kernels.on(pattern, kernels.proposal(function))`, or a `cycle`
        of several, of which the first whose pattern matches a choice holds. The weights correct for it, so the
        law and the evidence stay as they are.
    guide
        Draws all other choices that it knows; their weights are corrected, too.
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
        How many runs.
    """

    NAME = "forward"
    n: int = 1

    def __post_init__(self) -> None:
        """Check the settings."""
        self._check()


enumerate_all, rejection, importance, forward = EnumerateAll, Rejection, Importance, Forward
