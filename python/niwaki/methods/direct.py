"""Methods that need no chain and no population: forward runs, enumeration, rejection, likelihood weighting."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.errors import InputError
from niwaki.methods.checks import at_least_one, is_number, is_whole


@dataclass(frozen=True)
class EnumerateAll:
    """Exact enumeration; see `enumerate_all`."""

    max_runs: int = 1_000_000


@dataclass(frozen=True)
class Rejection:
    """Rejection sampling; see `rejection`."""

    n: int = 100
    bound: float = 0.0
    max_tries: int = 1_000_000


@dataclass(frozen=True)
class Importance:
    """Likelihood weighting; see `importance`."""

    n: int = 1000


@dataclass(frozen=True)
class Forward:
    """Runs of the prior; see `forward`."""

    n: int = 1


def enumerate_all(max_runs: int = 1_000_000) -> EnumerateAll:
    """The exact distribution of a model's value, by visiting every run; an error where none is possible.

    Parameters
    ----------
    max_runs
        Most complete runs to visit.
    """
    return EnumerateAll(at_least_one("max_runs", max_runs))


def rejection(n: int = 100, bound: float = 0.0, max_tries: int = 1_000_000) -> Rejection:
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
    if not is_number(bound) or bound != bound:
        raise InputError(
            "bad-setting", name="bound", found=repr(bound), expected="a number of nats", suggestion="0"
        )
    return Rejection(_samples(n), float(bound), at_least_one("max_tries", max_tries))


def importance(n: int = 1000) -> Importance:
    """Independent forward runs, each weighted by its score; an error where all are impossible.

    Parameters
    ----------
    n
        How many runs.
    """
    return Importance(_samples(n))


def forward(n: int = 1) -> Forward:
    """Runs of the prior: every choice is drawn from its distribution, whatever the score.

    Parameters
    ----------
    n
        How many runs.
    """
    return Forward(_samples(n))


def _samples(n: int) -> int:
    if not is_whole(n) or n < 1:
        raise InputError("no-samples", detail=f"n={n!r}")
    return n
