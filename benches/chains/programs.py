"""The four programs of appendix A and the kernel of each: the same proposals in all systems.

All choices are selected equally often. Discrete choices, probability vectors and deviations are proposed from the
prior; means, intercepts and slopes take a Gaussian step. A step is given in deviations of the choice's own
distribution: 0.02 of 10 is the peers' 0.2. An intercept of one sequence steps by 0.375 of the population's deviation,
which is the peers' 0.3 where that is the 0.8 that made the data, and a slope by 0.5 of it, their 0.2 at 0.4.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from data import UNITS
from niwaki import kernels
from niwaki.gallery.gmm import gmm
from niwaki.gallery.hlr import hlr
from niwaki.gallery.hmm import hmm
from niwaki.gallery.lda import lda
from niwaki.methods.kernels import Kernel


@dataclass(frozen=True)
class Program:
    """One program.

    Attributes
    ----------
    model
        It takes the number of observations.
    kernel, global_kernel
        Functions of that number: all choices; topics, means of components or means of populations alone.
    readers
        Mean number of calls that read one of those: a component has a quarter of the points on average.
    """

    name: str
    model: Any
    kernel: Callable[[int], Kernel | None]
    global_kernel: Kernel | None = None
    readers: Callable[[int], float] | None = None

    def count(self, size: int) -> int:
        """Observations, documents, points or sequences at a size."""
        return UNITS[self.name][1] * size


def weighted(*parts: tuple[int, str | list[str], Kernel]) -> Kernel:
    """Each kernel on its sites, as often as there are choices there: every choice has the same selection weight."""
    counts, sites, inner = zip(*parts, strict=True)
    restricted = [kernels.on(site, kernel) for site, kernel in zip(sites, inner, strict=True)]
    return kernels.mixture(*restricted, weights=counts)


def of_gmm(points: int) -> Kernel:
    rest = ["weights", "deviations", "k"]
    return weighted((4, "means", kernels.drift(0.02)), (5 + points, rest, kernels.prior()))


def of_hlr(sequences: int) -> Kernel:
    return weighted(
        (1, "intercept", kernels.drift(0.02)),
        (1, "slope", kernels.drift(0.01)),
        (3, ["intercept_spread", "slope_spread", "noise"], kernels.prior()),
        (sequences, "a", kernels.drift(0.375)),
        (sequences, "b", kernels.drift(0.5)),
    )


PROGRAMS = {
    "hmm": Program("hmm", hmm, lambda _: None),
    "lda": Program(
        "lda",
        lda,
        lambda _: None,
        kernels.on("topics", kernels.prior()),
        lambda documents: documents * 20 / 10,
    ),
    "gmm": Program("gmm", gmm, of_gmm, kernels.on("means", kernels.drift(0.02)), lambda points: points / 4),
    "hlr": Program(
        "hlr",
        hlr,
        of_hlr,
        weighted((1, "intercept", kernels.drift(0.02)), (1, "slope", kernels.drift(0.01))),
        lambda sequences: sequences,
    ),
}
