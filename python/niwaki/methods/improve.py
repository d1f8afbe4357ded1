"""Default search of `grow`: populations, parts that are grown again, and single choices that move."""

from __future__ import annotations

import os
from dataclasses import InitVar, dataclass
from typing import Any

from niwaki.errors.settings import bad
from niwaki.methods.checks import with_guide
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.refusals import as_real

#: The variable of the environment with the rounds of searches without `rounds`, `seconds` and `effort`.
VARIABLE = "NIWAKI_ROUNDS"
#: Rounds of a search without a limit, before `effort` was a setting.
ROUNDS_WITHOUT_EFFORT = 15


@dataclass(frozen=True)
class Improve(Method):
    """Search for one good run, which spends its work on the steps that gain most; it has no evidence and no weights.

    The search begins with a population. Rounds follow, each with a fifth of the population's work. A round grows parts
    of the best run again by few or by many particles, moves single choices, moves choices so that most parts of the
    scene stay (linkages), edits levels, or starts another population.
    A part is grown by fresh particles, and the best of them replaces the part if it is better. An edit of levels turns
    a count, adds an iteration of a loop or a level of a recursion, or removes one; what stands keeps its values, and
    the edited run is improved by moves before it is compared. Kinds of steps with recent gains
    get more of the rounds. Where no round has gained for long, the search restarts from a fresh population; the best of
    all restarts is the result.

    The search ends after `rounds` or before `seconds` are over. Without both it ends by its work: when a floor of work
    is spent and no round has gained for long. Work is counted in instructions of a processor, which are estimated from
    the model's instructions, shapes and host functions; no clock is read. A search also ends when no scene can be
    better, because all cells are right.

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
        The number of rounds, in place of a floor of work. Equal seeds and numbers of rounds give equal bits.
    seconds
        The time of the search, in place of a floor of work; no round begins that would end later. The numbers of rounds
        and of generations in `Result.info` repeat the search. None for no limit.
    effort
        The factor of the floor of work, by default 1: about a second of a processor. Below 1 the search ends sooner
        when no round gains, too. It has no effect with `rounds` or `seconds`.
    diverse
        The number of results that differ, best score first. The search for the best is made as it is alone; three times
        its work goes to an archive of the best runs of other kinds, or three quarters of `seconds`. Fewer results are
        possible, with a warning.
    generations
        The number of generations of eight short searches for other kinds, in place of three times the work.
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
        The proposal and the guide that draw choices in place of the prior, in populations and in most of the parts that
        are grown again, as for `importance`. The prior draws the other parts, and populations after one that died. No
        weight of prior over proposal corrects the draws: the best run counts by its score alone.
    """

    NAME = "improve"
    particles: int = 100
    regrow: int = 20
    power: float = 16.0
    rounds: int | None = None
    seconds: float | None = None
    effort: float | None = None
    diverse: int | None = None
    generations: int | None = None
    by: str | tuple[str, ...] = "kind"
    margin: float | None = 3.0
    bins: int = 10
    proposal: Kernel | None = None
    guide: InitVar[Guide | None] = None

    def __post_init__(self, guide: Guide | None) -> None:
        """Check the settings."""
        if self.rounds is None and self.seconds is None and self.effort is None:
            self._set("rounds", usual_rounds())
        self._set("effort", 1.0 if self.effort is None else self.effort)
        for name in ("power", "seconds", "effort", "margin"):
            self._set(name, as_real(getattr(self, name)))
        self._set("by", _names(self.by))
        self._set("proposal", with_guide(self.proposal, guide))
        self._check()

    @classmethod
    def _of_older(cls, settings: dict[str, Any]) -> dict[str, Any]:
        """Name the rounds of a search that was written before `effort` was a setting."""
        is_older = "effort" not in settings
        if is_older and settings.get("rounds") is None and settings.get("seconds") is None:
            return {**settings, "rounds": ROUNDS_WITHOUT_EFFORT}
        return settings


def usual_rounds() -> int | None:
    """Read `NIWAKI_ROUNDS`, the rounds of searches without `rounds`, `seconds` and `effort`; None if it is not set.

    Tests of what is around a search set it, so that all searches are short.
    """
    text = os.environ.get(VARIABLE)
    if not text:
        return None
    if not text.isdecimal() or int(text) == 0:
        raise bad(VARIABLE, text, "a number of rounds, at least 1", "15")
    return int(text)


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
