"""Statistics of a search, beside its samples: one class for each kind of method."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple


class Count(NamedTuple):
    """Proposals, and how many of them were kept."""

    proposed: int = 0
    kept: int = 0


@dataclass(frozen=True)
class Info:
    """Statistics that every method has.

    Attributes
    ----------
    log_evidence : float or None
        Log of the model's total probability, nats; estimated by particles and importance, exact by enumeration. None
        where the method has none, or where the search was stopped.
    """

    log_evidence: float | None = None


@dataclass(frozen=True)
class EnumerationInfo(Info):
    """Of enumeration.

    Attributes
    ----------
    table : sequence of (value, float)
        Each value of the model with the log of its probability, nats, not normalised.
    runs : int
        How many complete runs there are.
    """

    table: tuple[tuple[Any, float], ...] = ()
    runs: int = 0


@dataclass(frozen=True)
class RejectionInfo(Info):
    """Of rejection sampling.

    Attributes
    ----------
    tries : int
        Runs that it took.
    """

    tries: int = 0


@dataclass(frozen=True)
class PopulationInfo(Info):
    """Of `smc`.

    Attributes
    ----------
    plan : tuple of int
        Sizes of the populations; `smc(particles=plan)` with the same seed repeats a search by `seconds`.
    barriers : int
        Barriers of the population that met most.
    steps : int
        How often a particle ran to a barrier.
    resampled : int
        At how many barriers a population was resampled.
    ancestors : int
        Particles of the first barrier from which the final set descends.
    died : int
        Populations in which every particle became impossible; their evidence is zero, and counts.
    powers : tuple of float
        The power at each barrier where it is not constant, of the first population.
    moved_running, moved_ended : Count
        Proposals of rejuvenation: of particles that still ran, and of those that had ended.
    """

    plan: tuple[int, ...] = ()
    barriers: int = 0
    steps: int = 0
    resampled: int = 0
    ancestors: int = 0
    died: int = 0
    powers: tuple[float, ...] = ()
    moved_running: Count = Count()  # noqa: RUF009
    moved_ended: Count = Count()  # noqa: RUF009

    def __post_init__(self) -> None:
        """Name the counts of the engine."""
        for name in ("moved_running", "moved_ended"):
            object.__setattr__(self, name, Count(*getattr(self, name)))


@dataclass(frozen=True)
class SweepInfo(Info):
    """Of `particle_gibbs` and `pimh`, chains of whole runs.

    Attributes
    ----------
    tries : int
        How often the chain could have moved: ancestors drawn for the held run; proposals.
    moves : int
        How often it did: ancestors that were another particle; proposals accepted.
    renewed : tuple of float
        The share of choices that each sweep changed, from the first that found a possible run.
    died : int
        Populations in which every particle became impossible; their estimate is zero, and counts.
    """

    tries: int = 0
    moves: int = 0
    renewed: tuple[float, ...] = ()
    died: int = 0


class Round(NamedTuple):
    """A round of `improve`: its kind of step, its work (particle-steps, proposals, shapes), the best score then."""

    kind: str
    work: int
    best: float


@dataclass(frozen=True)
class ImproveInfo(Info):
    """Of `improve`.

    Attributes
    ----------
    rounds : tuple of Round
        The first population that had a possible run, and then each round.
    died : int
        Populations before it in which every particle became impossible.
    """

    rounds: tuple[Round, ...] = ()
    died: int = 0

    def __post_init__(self) -> None:
        """Name the rounds of the engine."""
        object.__setattr__(self, "rounds", tuple(Round(*one) for one in self.rounds))


#: The class of each method, by its name.
INFOS: dict[str, type[Info]] = {
    "enumerate_all": EnumerationInfo,
    "rejection": RejectionInfo,
    "smc": PopulationInfo,
    "particle_gibbs": SweepInfo,
    "pimh": SweepInfo,
    "improve": ImproveInfo,
}
