"""Statistics of a search, beside its samples: one class for each kind of method."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from math import exp, inf
from typing import Any, ClassVar, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from niwaki.errors.settings import bad
from niwaki.lang.blame import Blame
from niwaki.result.diagnostics import Summaries

S = TypeVar("S")


class Count(NamedTuple):
    """Proposals, and how many of them were kept."""

    proposed: int = 0
    kept: int = 0


class Losses(NamedTuple):
    """Partial runs that became impossible at barriers where others of their population lived. Its text is one line.

    Attributes
    ----------
    causes : tuple of (str, int)
        What made them impossible, and how many; most frequent first.
    blame : tuple of Blame
        The parts that broke a constraint, most frequent first.
    looked_at : int
        In how many of the runs these were looked for.
    """

    causes: tuple[tuple[str, int], ...] = ()
    blame: tuple[Blame, ...] = ()
    looked_at: int = 0

    @classmethod
    def of_several(cls, losses: Iterable[Losses]) -> Losses:
        """Those of several populations together."""
        causes: Counter[str] = Counter()
        blame: dict[Any, Blame] = {}
        looked_at = 0
        for one in losses:
            causes.update(dict(one.causes))
            looked_at += one.looked_at
            for own in one.blame:
                key = own.constraint, own.part[1:], own.other and own.other[1:]
                known = blame.get(key)
                blame[key] = own if known is None else known._replace(runs=known.runs + own.runs)
        ranked = sorted(blame.values(), key=lambda own: -own.runs)
        return cls(tuple(causes.most_common()), tuple(ranked), looked_at)

    @property
    def total(self) -> int:
        """How many partial runs were lost."""
        return sum(count for _, count in self.causes)

    def __str__(self) -> str:
        """How many, by what, and which parts; empty where none was lost."""
        if not self.causes:
            return ""
        by = ", ".join(f"{cause} ({count:,})" for cause, count in self.causes)
        said = [f"lost on the way: {self.total:,} partial run{'' if self.total == 1 else 's'}, by {by}"]
        of = "" if self.looked_at == self.total else " that were looked at"
        said += [f"{one} in {one.runs} of {self.looked_at}{of}" for one in self.blame[:1]]
        return "; ".join(said)


def _losses(data: Any) -> Losses:
    causes, blame, looked_at = data
    return Losses(tuple((cause, count) for cause, count in causes), tuple(map(Blame.of, blame)), looked_at)


@dataclass(frozen=True)
class Info:
    """Statistics that every method has.

    Attributes
    ----------
    log_evidence : float or None
        Log of the model's total probability, nats; estimated by particles, `ais` and importance, exact by enumeration.
        None where the method has none, or where the search was stopped.
    """

    log_evidence: float | None = None

    #: Whether the samples are those of chains.
    _HAS_CHAINS: ClassVar[bool] = False

    # What a result asks of its statistics: what only some methods have is None for the others.

    def _draws(self) -> dict[str, NDArray[Any]] | None:
        """Draws that are kept as numbers, by address."""
        return None

    def _statistics(self) -> dict[str, NDArray[Any]] | None:
        """Numbers of each draw by the names that ArviZ knows."""
        return None

    def _summary(self) -> Summaries | None:
        """Whether the draws can be trusted, where the statistics say more than the draws."""
        return None

    def _log_weights(self) -> NDArray[np.float64] | None:
        """Logs of the weights of draws that are kept as numbers."""
        return None

    def _pool(self, samples: Sequence[S]) -> Sequence[Any]:
        """The samples of which the best is taken."""
        return samples

    def _says(self, samples: str) -> list[str] | None:
        """How a result is described in one line, given how many samples it has; None: by the best of them."""
        return None

    def _go_on(self, result: Any, steps: int | None) -> None:
        """Go on with the chains of a result, which is changed."""
        suggestion = "`mh(...)`, or call `polish` first"
        raise bad("method", result.method, "a result of `mh`, whose chains can go on", suggestion)


@dataclass(frozen=True)
class EnumerationInfo(Info):
    """Of enumeration.

    Attributes
    ----------
    table : sequence of (value, float)
        Each value of the model with the log of its probability, nats, not normalised.
    runs : int
        How many complete runs were visited.
    unseen : float
        The prior probability of the runs that were not, by `likely`.
    log_unseen : float or None
        Log of the most that they add to the evidence, nats, if the rest of a run adds at most `rest` to its score. None
        where nothing is left.
    """

    table: tuple[tuple[Any, float], ...] = ()
    runs: int = 0
    unseen: float = 0.0
    log_unseen: float | None = None

    def _says(self, samples: str) -> list[str]:
        return [f"{len(self.table)} values, {self.runs} runs"]

    def bounds(self, value: Any) -> tuple[float, float]:
        """The probability of a value lies between these; both are the same where all runs were visited.

        Parameters
        ----------
        value
            A value of the model. Where the model has both, `1` is not `True`, and `0.0` not `-0.0`.
        """
        same = [found for found, _ in self.table if repr(found) == repr(value)]
        unseen = -inf if self.log_unseen is None else self.log_unseen
        most = max([unseen, *(log for _, log in self.table)])
        seen = sum(exp(log - most) for _, log in self.table)
        own = sum(
            exp(log - most)
            for found, log in self.table
            if (repr(found) == repr(value) if same else found == value)
        )
        left = exp(unseen - most)
        return own / (seen + left), (own + left) / (seen + left)


@dataclass(frozen=True)
class AnnealedInfo(Info):
    """Of annealed importance sampling.

    Attributes
    ----------
    effective : float
        The effective sample size of the weights, between 1 and the number of particles. A small one says that the
        ladder has too few rungs, or too few moves at each.
    powers : tuple of float
        The powers of the score, without the first, 0.
    tries : int
        Forward runs that the first states took: as many as particles where every run of the prior is possible.
    moved : Count
        Proposals of all particles, and those that were kept.
    """

    effective: float = 0.0
    powers: tuple[float, ...] = ()
    tries: int = 0
    moved: Count = Count()  # noqa: RUF009

    def __post_init__(self) -> None:
        """Name the counts of the engine."""
        object.__setattr__(self, "moved", Count(*self.moved))


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
    log_normaliser : float or None
        Log of the final law's normalising constant, nats: with scores raised to `power`, so that it is
        `log_evidence` at power 1. None for absolute weights, and where the search was stopped.
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
    losses : Losses
        Particles that became impossible while others lived.
    """

    log_normaliser: float | None = None
    plan: tuple[int, ...] = ()
    barriers: int = 0
    steps: int = 0
    resampled: int = 0
    ancestors: int = 0
    died: int = 0
    powers: tuple[float, ...] = ()
    moved_running: Count = Count()  # noqa: RUF009
    moved_ended: Count = Count()  # noqa: RUF009
    losses: Losses = Losses()  # noqa: RUF009

    def __post_init__(self) -> None:
        """Name the counts of the engine."""
        object.__setattr__(self, "losses", _losses(self.losses))
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


class Attempt(NamedTuple):
    """A first population of `improve`: its form, its particles, and the barrier at which the last died, or None."""

    form: str
    particles: int
    died_at: int | None = None


class Round(NamedTuple):
    """A round of `improve`.

    Attributes
    ----------
    kind : str
        Its kind of step: "population", "regrow", "regrow more" or "move".
    work : int
        Particle-steps, proposals, and shapes that proposals placed or removed.
    best : float
        The best log score after it, nats.
    parts : int
        Parts that were grown again and kept.
    """

    kind: str
    work: int
    best: float
    parts: int


@dataclass(frozen=True)
class ImproveInfo(Info):
    """Of `improve`; of several results, that of the search with the best. Its text says what was done.

    Attributes
    ----------
    attempts : tuple of Attempt
        The populations that were tried until one lived.
    rounds : tuple of Round
        That population, and then each round.
    searches : int
        Searches for results that differ.
    losses : Losses
        Particles of the first population that lived, which became impossible.
    seconds : tuple of float
        When each round ended, from the beginning, by the clock. Two searches with other seconds alone are equal.
    """

    attempts: tuple[Attempt, ...] = ()
    rounds: tuple[Round, ...] = ()
    searches: int = 1
    losses: Losses = Losses()  # noqa: RUF009
    seconds: tuple[float, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        """Name the rounds of the engine."""
        object.__setattr__(self, "losses", _losses(self.losses))
        object.__setattr__(self, "attempts", tuple(Attempt(*one) for one in self.attempts))
        object.__setattr__(self, "rounds", tuple(Round(*one) for one in self.rounds))

    def __str__(self) -> str:
        """What was done, with the seconds and the best log score then."""
        said = []
        for one in self.attempts:
            form = "" if one is self.attempts[0] else f" ({one.form})"
            how = "" if one.died_at is None else f", which died at barrier {one.died_at}"
            said.append(f"population of {one.particles}{form}{how}")
        if self.rounds:
            said[-1] += self._at(0)
        if len(self.rounds) > 1:
            later = self.rounds[1:]
            parts, moves, more = (
                sum(one.parts for one in later),
                any(one.kind == "move" for one in later),
                sum(one.kind == "population" for one in later),
            )
            what = [f"{parts} part{'' if parts == 1 else 's'} grown again"]
            what += [f"{more} more population{'' if more == 1 else 's'}"] * (more > 0)
            what += ["single choices moved"] * moves
            said.append(", ".join(what) + self._at(-1))
        return "; ".join(said)

    def _at(self, number: int) -> str:
        """When a round ended, and with which score."""
        return f", {self.seconds[number]:.1f} s: {self.rounds[number].best:.1f}"


#: The class of each method, by its name.
INFOS: dict[str, type[Info]] = {
    "ais": AnnealedInfo,
    "enumerate_all": EnumerationInfo,
    "rejection": RejectionInfo,
    "smc": PopulationInfo,
    "particle_gibbs": SweepInfo,
    "pimh": SweepInfo,
    "improve": ImproveInfo,
}


def without_evidence(info: Info) -> Info:
    """The statistics of one of several runs, which have no constant in common."""
    if isinstance(info, PopulationInfo):
        return replace(info, log_evidence=None, log_normaliser=None)
    return replace(info, log_evidence=None)


def stored_info(info: Info) -> dict[str, Any] | None:
    """Statistics as plain data; None for those of chains, which runs do not share."""
    kinds = {type(info): name for name, kind in INFOS.items() if type(info) is kind}
    if type(info) is not Info and not kinds:
        return None
    return {"method": kinds.get(type(info), ""), "fields": asdict(info)}


def restored_info(data: dict[str, Any] | None) -> Info:
    """Statistics of what `stored_info` gave."""
    if data is None:
        return Info()
    fields = {name: _tuples(value) for name, value in data["fields"].items()}
    return INFOS.get(data["method"], Info)(**fields)


def _tuples(value: Any) -> Any:
    """Lists as tuples, at any depth."""
    return tuple(_tuples(one) for one in value) if isinstance(value, list) else value
