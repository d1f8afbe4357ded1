"""Default search of `grow`: populations, parts that are grown again, and single choices that move."""

from __future__ import annotations

from dataclasses import InitVar, dataclass
from typing import Any

from niwaki.errors.settings import bad
from niwaki.methods.checks import with_guide
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class Improve(Method):
    """Search for one good run, which spends its work on the steps that gain most; it has no evidence and no weights.

    The search begins with a population. Rounds follow, each with a fifth of the population's work. A round grows parts
    of the best run again by few or by many particles, moves single choices, or starts another population. A part is
    grown by fresh particles, and the best of them replaces the part if it is better. Kinds of steps with recent gains
    get more of the rounds. The search ends after `rounds`, after `seconds`, or after many rounds without a gain.

    If all particles of the first population die, the search tries populations of other forms, less greedy or larger;
    `Result.info` lists them.

    Parameters
    ----------
    particles
        The number of particles of a population.
    regrow
        The number of particles that grow a part again, at least 2; some rounds take five times as many.
    power
        The power of the score: 1 follows the posterior, a higher power sharpens the search.
    rounds
        The most rounds; by default 15, or no limit with `seconds`. Work is counted and not timed, so equal seeds and
        numbers of rounds give equal bits.
    seconds
        The time after which no round begins; the number of rounds in `Result.info` repeats the search. None for no
        limit.
    diverse
        The number of results that differ, best score first. The search for the best is made as it is alone; three times
        its work goes to an archive of the best runs of other kinds. Fewer results are possible, with a warning. Not
        with `seconds`.
    by
        What tells results apart. "kind": finite choices and numbers of calls that carry at least a tenth of the scene's
        cells. "look": the share of filled cells in common. A list of choices, by address or label: a result for each
        combination of their values. The key of a `query`: a result for each of its values.
    margin
        The nats below the best within which a result of another kind comes before a second result of one kind. None for
        no limit.
    bins
        The number of bins of a real choice or query in `by`, between its least and its largest value in the first
        population.
    proposal, guide
        The proposal and the guide that draw choices in place of the prior, in populations and in parts that are grown
        again, as for `importance`.
    """

    NAME = "improve"
    particles: int = 100
    regrow: int = 20
    power: float = 16.0
    rounds: int | None = None
    seconds: float | None = None
    diverse: int | None = None
    by: str | tuple[str, ...] = "kind"
    margin: float | None = 3.0
    bins: int = 10
    proposal: Kernel | None = None
    guide: InitVar[Guide | None] = None

    def __post_init__(self, guide: Guide | None) -> None:
        """Check the settings."""
        for name in ("power", "seconds", "margin"):
            self._set(name, as_real(getattr(self, name)))
        self._set("by", _names(self.by))
        self._set("proposal", with_guide(self.proposal, guide))
        self._check()


def _names(by: Any) -> str | tuple[str, ...]:
    """Return what tells results apart: a word, or a tuple of choices.

    Raises
    ------
    InputError
        Neither a text nor texts.
    """
    if isinstance(by, str) and by:
        return by
    if isinstance(by, list | tuple) and by and all(isinstance(name, str) and name for name in by):
        return tuple(by)
    raise bad("by", by, '"kind", "look", a list of choices, or the key of a query', '"kind"')


improve = Improve
