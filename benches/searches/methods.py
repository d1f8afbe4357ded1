"""The methods: each is one line, the settings of `niwaki.grow` for a size that makes it cost as much as another.

`default` has no size: it is what a user gets. `fifteen rounds` has none, either: it is the default at the work that it
had before searches spent a floor of work. Every other method is given the CPU seconds of the default, on the problem at
hand, by its size: a number of particles, of proposals or of sweeps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from niwaki import kernels, mh, particle_gibbs

#: The power of the default's population.
POWER = 16.0
#: What chains of this bench propose: one choice, from the prior or a small step; seldom all from some call on. They are
#: as sharp as the default's population.
MOVES = kernels.anneal(
    kernels.mixture(
        kernels.prior(), kernels.drift(0.3), kernels.drift(0.05), kernels.regenerate(), weights=[4, 4, 2, 1]
    ),
    1,
    POWER,
    POWER,
)


@dataclass(frozen=True)
class Method:
    """One column of the bench.

    Attributes
    ----------
    name : str
    settings
        The keyword arguments of `niwaki.grow` for a size.
    size : int
        With which the search for the right size begins; 0 for a method without one.
    """

    name: str
    settings: Callable[[int], dict[str, Any]]
    size: int = 0

    def text(self, size: int) -> str:
        """The settings for a size, to tell whether a record is of this method or of an older one of this name."""
        return ", ".join(f"{name}={value!r}" for name, value in self.settings(size).items())


METHODS = (
    Method("default", lambda _: {}),
    Method("fifteen rounds", lambda _: {"rounds": 15}),
    Method("one population", lambda n: {"particles": n}, 300),
    Method("absolute weights", lambda n: {"particles": n, "weights": "absolute"}, 300),
    Method("depth-first", lambda n: {"particles": n, "order": "depth-first"}, 300),
    Method("resampling below 0.5", lambda n: {"particles": n, "ess": 0.5}, 300),
    Method("annealed by 0.5", lambda n: {"particles": n, "anneal": 0.5}, 100),
    Method("four populations", lambda n: {"particles": n, "populations": 4}, 75),
    Method("population and chain", lambda n: {"particles": 100, "polish": mh(n, kernel=MOVES, keep=0)}, 3000),
    Method("chain", lambda n: {"method": mh(n, kernel=MOVES, keep=0)}, 3000),
    Method(
        "particle Gibbs",
        lambda n: {"method": particle_gibbs(50, n, power=POWER)},
        4,
    ),
)


def method(name: str) -> Method:
    """Find the method of that name."""
    return next(candidate for candidate in METHODS if candidate.name == name)
