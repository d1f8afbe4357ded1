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
from niwaki.lang.labels import Labels
from niwaki.result.diagnostics import Summaries
from niwaki.shares import percent

S = TypeVar("S")


class Count(NamedTuple):
    """Numbers of proposals, and of accepted proposals."""

    proposed: int = 0
    kept: int = 0


class Losses(NamedTuple):
    """Partial runs that became impossible at barriers at which others of their population lived. Its text is one line.

    Attributes
    ----------
    causes : tuple of (str, int)
        The causes with their numbers of runs, most frequent first.
    blame : tuple of Blame
        The parts that broke a constraint, most frequent first.
    looked_at : int
        The number of runs in which parts were looked for.
    """

    causes: tuple[tuple[str, int], ...] = ()
    blame: tuple[Blame, ...] = ()
    looked_at: int = 0

    @classmethod
    def of_several(cls, losses: Iterable[Losses]) -> Losses:
        """Merge the losses of several populations."""
        causes: Counter[str] = Counter()
        blame: dict[Any, Blame] = {}
        looked_at = 0
        for population in losses:
            causes.update(dict(population.causes))
            looked_at += population.looked_at
            for entry in population.blame:
                key = entry.constraint, entry.part[1:], entry.other and entry.other[1:]
                before = blame.get(key)
                blame[key] = entry if before is None else before._replace(runs=before.runs + entry.runs)
        ranked = sorted(blame.values(), key=lambda entry: -entry.runs)
        return cls(tuple(causes.most_common()), tuple(ranked), looked_at)

    @property
    def total(self) -> int:
        """The number of lost partial runs."""
        return sum(count for _, count in self.causes)

    def text(self, labels: Labels) -> str:
        """Return the number of losses, the causes and a part by its label; empty without losses."""
        if not self.causes:
            return ""
        by = ", ".join(f"{cause} ({count:,})" for cause, count in self.causes)
        texts = [f"lost on the way: {self.total:,} partial run{'' if self.total == 1 else 's'}, by {by}"]
        of = "" if self.looked_at == self.total else " that were looked at"
        texts += [f"{entry.text(labels)} in {entry.runs} of {self.looked_at}{of}" for entry in self.blame[:1]]
        return "; ".join(texts)

    def __str__(self) -> str:
        return self.text(Labels())


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
        None for other methods, and for a search that was stopped.
    """

    log_evidence: float | None = None

    #: Whether the samples are those of chains.
    _HAS_CHAINS: ClassVar[bool] = False

    # A result reads these; None stands for statistics that a method does not have.

    def _draws(self) -> dict[str, NDArray[Any]] | None:
        """Draws that are stored as numbers, by address."""
        return None

    def _statistics(self) -> dict[str, NDArray[Any]] | None:
        """Numbers of each draw by the names that ArviZ knows."""
        return None

    def _summary(self) -> Summaries | None:
        """Summary of the draws and of statistics that are not in the draws."""
        return None

    def _log_weights(self) -> NDArray[np.float64] | None:
        """Logs of the weights of draws that are stored as numbers."""
        return None

    def _pool(self, samples: Sequence[S]) -> Sequence[Any]:
        """The samples among which the best is found."""
        return samples

    def _repr_parts(self, samples: str) -> list[str] | None:
        """Parts of a line that describes a result, with a text about its samples; None for its best sample."""
        return None

    def _go_on(self, result: Any, steps: int | None) -> None:
        """Continue the chains of a result, which is changed."""
        suggestion = "`mh(...)`, or call `polish` first"
        raise bad("method", result.method, "a result of `mh`, whose chains can continue", suggestion)


@dataclass(frozen=True)
class EnumerationInfo(Info):
    """Statistics of enumeration.

    Attributes
    ----------
    table : sequence of (value, float)
        Each value of the model with the log of its probability, nats, not normalised.
    runs : int
        The number of complete runs that were visited.
    unseen : float
        The prior probability of the runs that were not visited, by `likely`.
    log_unseen : float or None
        Log of the most that they add to the evidence, nats, if the rest of a run adds at most `rest` to its score. None
        if every run was visited.
    """

    table: tuple[tuple[Any, float], ...] = ()
    runs: int = 0
    unseen: float = 0.0
    log_unseen: float | None = None

    def _repr_parts(self, samples: str) -> list[str]:
        return [f"{len(self.table)} values, {self.runs} runs"]

    def bounds(self, value: Any) -> tuple[float, float]:
        """Bound the probability of a value; both bounds are equal if all runs were visited.

        Parameters
        ----------
        value
            A value of the model. If the model has both, `1` is not `True`, and `0.0` is not `-0.0`.
        """
        is_listed = any(repr(entry) == repr(value) for entry, _ in self.table)
        unseen = -inf if self.log_unseen is None else self.log_unseen
        most = max([unseen, *(log for _, log in self.table)])
        seen = sum(exp(log - most) for _, log in self.table)
        share = sum(
            exp(log - most)
            for entry, log in self.table
            if (repr(entry) == repr(value) if is_listed else entry == value)
        )
        rest = exp(unseen - most)
        return share / (seen + rest), (share + rest) / (seen + rest)


@dataclass(frozen=True)
class AnnealedInfo(Info):
    """Statistics of annealed importance sampling.

    Attributes
    ----------
    effective : float
        The effective sample size of the weights, between 1 and the number of particles. It is small if the ladder has
        too few rungs, or too few moves at each rung.
    powers : tuple of float
        The powers of the score, without the first, 0.
    tries : int
        The number of forward runs for the first states: the number of particles if every run of the prior is possible.
    moved : Count
        Proposals of all particles, and the accepted ones.
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
    """Statistics of rejection sampling.

    Attributes
    ----------
    tries : int
        The number of runs that were drawn.
    """

    tries: int = 0


@dataclass(frozen=True)
class PopulationInfo(Info):
    """Statistics of `smc`.

    Attributes
    ----------
    log_normaliser : float or None
        Log of the normalising constant of the final distribution, nats, with scores raised to `power`: it is
        `log_evidence` at power 1. None for absolute weights, and for a search that was stopped.
    plan : tuple of int
        Sizes of the populations; `smc(particles=plan)` with the same seed repeats a search by `seconds`.
    barriers : int
        The number of barriers of the population with most barriers.
    steps : int
        The number of times that a particle ran to a barrier.
    resampled : int
        The number of barriers at which a population was resampled.
    ancestors : int
        The number of particles of the first barrier from which the final set descends.
    died : int
        The number of populations in which every particle became impossible; their evidence counts as zero.
    powers : tuple of float
        The power at each barrier of the first population, if the power is not constant.
    moved_running, moved_ended : Count
        Proposals of rejuvenation, for running particles and for particles that had ended.
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
    """Statistics of `particle_gibbs` and `pimh`, chains of whole runs.

    Attributes
    ----------
    tries : int
        The number of draws of an ancestor for the held run, or of proposals.
    moves : int
        The number of ancestors that were another particle, or of accepted proposals.
    renewed : tuple of float
        The share of choices that each sweep changed, from the first sweep with a possible run.
    died : int
        The number of populations in which every particle became impossible; their estimate counts as zero.
    """

    tries: int = 0
    moves: int = 0
    renewed: tuple[float, ...] = ()
    died: int = 0


class Attempt(NamedTuple):
    """First population of `improve`: its form, its particles, and the barrier at which all were dead, or None."""

    form: str
    particles: int
    died_at: int | None = None


class Round(NamedTuple):
    """Round of `improve`.

    Attributes
    ----------
    step : str
        The kind of step: "population", "start" (a run that was given), "restart", "regrow", "regrow more", "move",
        "linkage" or "levels".
    work : int
        The number of particle-steps, of proposals, and of shapes that proposals placed or removed.
    best : float
        The best log score after the round, nats.
    parts : int
        The number of parts that were grown again and accepted, or of edits that were.
    """

    step: str
    work: int
    best: float
    parts: int


@dataclass(frozen=True)
class EmulateInfo(Info):
    """Statistics of `emulate`; of several results, of the search with the best one.

    Attributes
    ----------
    evaluations : int
        The number of runs, with those that were invalid.
    choices : int
        The number of choices that were searched.
    best_at : int
        The number of the best run, from 0.
    searches : int
        The number of searches for results that differ.
    """

    evaluations: int = 0
    choices: int = 0
    best_at: int = 0
    searches: int = 1

    def __str__(self) -> str:
        """The number of runs, and which was the best."""
        return (
            f"emulator: {self.evaluations} runs of {self.choices} choices; the best is run {self.best_at + 1}"
        )


@dataclass(frozen=True)
class ImproveInfo(Info):
    """Statistics of `improve`; of several results, of the search with the best one. Its text describes the rounds.

    Attributes
    ----------
    attempts : tuple of Attempt
        The populations that were tried until one lived.
    rounds : tuple of Round
        The population that lived or the run that was given, and then each round.
    searches : int
        The number of searches for results that differ.
    kinds : tuple of dict
        For each of several results what tells it apart: a value for each place. A place is an address without the
        numbers of iterations; a place that ends in "/" is that of a call, and its value the number of calls.
    niches : int
        The number of kinds that the search for several results has met and keeps.
    other_work : int
        The work of its searches for other kinds, in the unit of the work of rounds.
    generations : int
        The number of generations of these searches.
    price : int
        The instructions of a processor for a unit of work, estimated from the best run of the first population.
    losses : Losses
        The particles that became impossible in the population that lived.
    seconds : tuple of float
        Seconds from the beginning to the end of each round. Comparisons of statistics ignore them.
    """

    attempts: tuple[Attempt, ...] = ()
    rounds: tuple[Round, ...] = ()
    searches: int = 1
    kinds: tuple[dict[str, str], ...] = ()
    niches: int = 0
    other_work: int = 0
    generations: int = 0
    price: int = 0
    losses: Losses = Losses()  # noqa: RUF009
    seconds: tuple[float, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        """Name the rounds of the engine."""
        object.__setattr__(self, "losses", _losses(self.losses))
        object.__setattr__(self, "attempts", tuple(Attempt(*fields) for fields in self.attempts))
        object.__setattr__(self, "rounds", tuple(Round(*fields) for fields in self.rounds))
        object.__setattr__(self, "kinds", tuple(dict(kind) for kind in self.kinds))

    @property
    def spent(self) -> dict[str, int]:
        """The work by kind of step, in instructions of a processor as `price` estimates them; the largest first."""
        work: dict[str, int] = {}
        for each in self.rounds:
            work[each.step] = work.get(each.step, 0) + each.work * self.price
        return dict(sorted(work.items(), key=lambda item: -item[1]))

    @property
    def bill(self) -> str:
        """The work in one line: instructions, rounds, restarts, and the share of each kind of step."""
        spent, rounds = self.spent, len(self.rounds) - 1
        whole = sum(spent.values())
        counts = [f"{rounds} round{'' if rounds == 1 else 's'}"]
        counts += [f"{self.restarts} restart{'' if self.restarts == 1 else 's'}"] * (self.restarts > 0)
        shares = ", ".join(f"{kind} {percent(work / max(whole, 1))}" for kind, work in spent.items())
        return f"about {whole / 1e6:,.0f} million instructions in {' and '.join(counts)}: {shares}"

    @property
    def restarts(self) -> int:
        """The number of fresh populations from which the search went on."""
        return sum(each.step == "restart" for each in self.rounds)

    def __str__(self) -> str:
        """The steps of the search, with the seconds and the best log score after them."""
        steps = []
        for attempt in self.attempts:
            form = "" if attempt is self.attempts[0] else f" ({attempt.form})"
            end = "" if attempt.died_at is None else f", which died at barrier {attempt.died_at}"
            steps.append(f"population of {attempt.particles}{form}{end}")
        if self.rounds and not steps:
            steps.append("a run that was given")
        if self.rounds:
            steps[-1] += self._at(0)
        if len(self.rounds) > 1:
            later = self.rounds[1:]
            parts, levels, moves, more = (
                sum(each.parts for each in later if each.step != "levels"),
                sum(each.parts for each in later if each.step == "levels"),
                any(each.step == "move" for each in later),
                sum(each.step == "population" for each in later),
            )
            kinds = [f"{parts} part{'' if parts == 1 else 's'} grown again"]
            kinds += [f"{more} more population{'' if more == 1 else 's'}"] * (more > 0)
            kinds += [f"{self.restarts} restart{'' if self.restarts == 1 else 's'}"] * (self.restarts > 0)
            kinds += ["single choices moved"] * moves
            kinds += [f"{levels} edit{'' if levels == 1 else 's'} of levels"] * (levels > 0)
            steps.append(", ".join(kinds) + self._at(-1))
        return "; ".join(steps)

    def _at(self, number: int) -> str:
        """The time and the best score at the end of a round."""
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
    "emulate": EmulateInfo,
}


def without_evidence(info: Info) -> Info:
    """Remove the evidence from the statistics of one of several runs, which have no normalising constant in common."""
    if isinstance(info, PopulationInfo):
        return replace(info, log_evidence=None, log_normaliser=None)
    return replace(info, log_evidence=None)


def stored_info(info: Info) -> dict[str, Any] | None:
    """Write statistics as plain data; None for statistics of chains, which runs do not share."""
    kinds = {type(info): name for name, kind in INFOS.items() if type(info) is kind}
    if type(info) is not Info and not kinds:
        return None
    return {"method": kinds.get(type(info), ""), "fields": asdict(info)}


def restored_info(data: dict[str, Any] | None) -> Info:
    """Read statistics from the data of `stored_info`."""
    if data is None:
        return Info()
    fields = {name: _tuples(value) for name, value in data["fields"].items()}
    return INFOS.get(data["method"], Info)(**fields)


def _tuples(value: Any) -> Any:
    """Replace lists by tuples, at any depth."""
    return tuple(_tuples(entry) for entry in value) if isinstance(value, list) else value
