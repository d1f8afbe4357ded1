"""The usual search: populations, parts that are grown again, and single choices that move."""

from __future__ import annotations

from dataclasses import InitVar, dataclass

from niwaki.methods.checks import guided
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class Improve(Method):
    """Search for one good run, with the effort where it gains: a search, which gives no evidence and no weights.

    It begins with a population. Rounds follow, each with a fifth of that population's work: parts of the best run are
    grown again (as `kernels.regrow` does, but from fresh particles alone, whose best takes the part's place where it is
    better) by few or by many particles, single choices move, or another population starts. What gained lately gets more
    of the rounds. It ends after `rounds`, after `seconds`, or when nothing has been gained for long.

    Where all particles of the first population die, others of other forms are tried, less greedy or larger ones;
    `Result.info` names them.

    Parameters
    ----------
    particles
        Of a population.
    regrow
        Particles that grow a part again, or five times as many; at least 2.
    power
        The power of the score: 1 follows the posterior, more sharpens the search.
    rounds
        Most rounds; 15, or without end where `seconds` is given, when left out. Work is counted and not timed, so the
        same seed and number of rounds give the same bits.
    seconds
        No round begins after so many seconds; the number of rounds in `Result.info` repeats the search. None for no
        limit.
    diverse
        Give so many results that differ, best score first, from as many searches side by side with six tenths of the
        particles: none shares more than half of its choices with another. Where fewer are found, fewer are given, with
        a warning. Not with `seconds`.
    proposal, guide
        What draws the choices of populations, and of parts that are grown again, in place of the prior, as for
        `importance`.
    """

    NAME = "improve"
    particles: int = 100
    regrow: int = 20
    power: float = 16.0
    rounds: int | None = None
    seconds: float | None = None
    diverse: int | None = None
    proposal: Kernel | None = None
    guide: InitVar[Guide | None] = None

    def __post_init__(self, guide: Guide | None) -> None:
        """Check the settings."""
        for name in ("power", "seconds"):
            self._set(name, as_real(getattr(self, name)))
        self._set("proposal", guided(self.proposal, guide))
        self._check()


improve = Improve
