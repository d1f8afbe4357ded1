"""Results of chains that follow a gradient: draws by address, diagnostics, each draw as a sample.

Draws are kept as numbers; a draw becomes a `Sample`, with scene and choices, when it is read.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.errors import ModelFault
from niwaki.lang.compiled import as_fault, translated
from niwaki.methods import Hmc, Nuts
from niwaki.once import cached_property
from niwaki.result.diagnostics import Divergences
from niwaki.result.info import Info
from niwaki.result.sample import Sample

if TYPE_CHECKING:
    from niwaki.search import Search

Reals = NDArray[np.float64]

#: The share of trajectories without a finite gradient above which there is a warning.
SOME = 0.01


class GradientWarning(UserWarning):
    """Chains that follow a gradient gave draws, but did not move every choice or reach every place."""


def say(text: str) -> None:
    """Warn at the line of the user's code that started the search."""
    depth, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals["__name__"].startswith("niwaki."):
        depth, frame = depth + 1, frame.f_back
    warnings.warn(text, GradientWarning, stacklevel=depth)


def listed(paths: Sequence[str]) -> str:
    """The first few of some choices."""
    return ", ".join(f"`{path}`" for path in paths[:5]) + (
        f" and {len(paths) - 5} more" if len(paths) > 5 else ""
    )


def kept(paths: Sequence[str], name: str) -> str:
    """The warning that discrete choices kept their values."""
    many = len(paths) > 1
    return (
        f"{len(paths)} discrete choice{'s' if many else ''} of `{name}` kept the value of each "
        f"chain's start, because a gradient does not move {'them' if many else 'it'}: {listed(paths)}; "
        f"draws are conditional on {'those values' if many else 'that value'}; "
        f"use `mh()` where {'they' if many else 'it'} should vary"
    )


def refused(count: int, trajectories: int, name: str) -> str:
    """The warning that trajectories were refused for structure."""
    return (
        f"{count} of {trajectories} trajectories of `{name}` after the warm-up were refused for structure: "
        f"the model makes other choices at the points that they reached, and a gradient cannot change the structure"
    )


def diverged(count: int, trajectories: int, name: str, smaller: str) -> str:
    """The warning that trajectories diverged; `smaller` describes how to get a smaller step."""
    return (
        f"{count} of {trajectories} trajectories of `{name}` after the warm-up diverged: the step is too large where "
        f"the density bends sharply, and the draws may miss such places; {smaller}, or reparametrise: instead of "
        f"`gaussian(mean, spread)` with a `spread` that is a choice itself, write `mean + spread * gaussian(0, 1)`"
    )


def without_slope(count: int, name: str, fault: ModelFault | None) -> str:
    """The warning that a gradient was not finite; without a fault, neither were the coordinates."""
    why = (
        f"the first:\n{fault.render()}"
        if fault
        else "they left the range of numbers: give the values other units"
    )
    return (
        f"{count} trajectories of `{name}` reached points without a finite gradient and were rejected; {why}"
    )


def together(chains: Sequence[Mapping[str, NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    """The values of several chains, (chains, draws, ...), of the choices that all of them have."""
    return {
        path: np.array([chain[path] for chain in chains])
        for path, values in (chains[0].items() if chains else ())
        if all(path in chain and chain[path].shape == values.shape for chain in chains)
    }


class Drawn(Sequence[Sample]):
    """Draws as samples, those of the first chain first: each is created by a run of the model when it is read."""

    def __init__(self, info: HmcInfo, seconds: tuple[float, float]) -> None:
        self._info, self._seconds = info, seconds
        self._ends = np.cumsum(info.sizes, dtype=np.int64)

    def __len__(self) -> int:
        return int(self._ends[-1]) if len(self._ends) else 0

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[place] for place in range(*index.indices(len(self)))]
        place = index + len(self) if index < 0 else index
        if not 0 <= place < len(self):
            raise IndexError("no such sample")
        info, chain = self._info, int(np.searchsorted(self._ends, place, side="right"))
        choices = info.choices(chain, place - (int(self._ends[chain - 1]) if chain else 0))
        with translated(info.search.model.name, f"seed={info.seed}", choices):
            trace = info.search.task.replay(choices)
        return Sample.of_trace(trace, info.search, info.seed, *self._seconds)

    def __iter__(self) -> Iterator[Sample]:
        return (self[place] for place in range(len(self)))


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class HmcInfo(Info):
    """Of `hmc`, `nuts` and `explore`: the draws as numbers, and statistics of the trajectories.

    Chains that were stopped may have different lengths; arrays (chains, draws) then hold as many draws as the shortest.

    Attributes
    ----------
    search, seed
        The search, and the seed of the chains.
    log_density : array of shape (chains, draws)
        Over the coordinates in which the chains move, Jacobians included, nats.
    stats : dict of str to array
        Of each draw, (chains, draws): `energy` (nats), `acceptance_rate`, `n_steps`, `tree_depth`, and
        whether a trajectory since the draw before was refused for structure (`refused_for_structure`) or broke off for
        another reason (`diverging`).
    step_size : array of shape (chains,)
        The step sizes that the warm-up ended with.
    divergences : Divergences
        Trajectories that broke off after the warm-up, by the reason, all chains together: `structure` counts those
        that were refused for structure, `energy` those that diverged.
    gradients : int
        Gradients taken, warm-up included.
    fixed : list of dict
        The choices that each chain held fixed, by address.
    fault : ModelFault or None
        The fault, with its line, of the first trajectory that reached a point without a finite gradient.
    sizes : tuple of int
        How many draws each chain has.
    """

    search: Search
    seed: int
    sizes: tuple[int, ...]
    log_density: Reals
    stats: dict[str, NDArray[Any]]
    step_size: Reals
    divergences: Divergences
    gradients: int
    fixed: list[dict[str, Any]]
    fault: ModelFault | None
    _trajectories: _engine.Trajectories | None

    @classmethod
    def of(cls, search: Search, seed: int, found: _engine.Trajectories) -> HmcInfo:
        """The results of chains on the engine."""
        chains = range(found.chains)
        draws = [found.draws(chain) for chain in chains]
        counts = [found.counters(chain) for chain in chains]
        sizes = tuple(len(one["energy"]) for one in draws)
        stats = {name: np.array([one[name][: min(sizes)] for one in draws]) for name in draws[0]}
        faults = (found.fault(chain) for chain in chains)
        first = next((fault for fault in faults if fault is not None), None)
        return cls(
            search=search,
            seed=seed,
            sizes=sizes,
            log_density=stats.pop("log_density"),
            stats=stats,
            step_size=np.array([count["step_size"] for count in counts]),
            divergences=sum((Divergences(**count["divergences"]) for count in counts), Divergences()),
            gradients=sum(count["gradients"] for count in counts),
            fixed=[{choice.path: choice.value for choice in found.fixed(chain)} for chain in chains],
            fault=as_fault(first, search.model.name, f"seed={seed}"),
            _trajectories=found,
        )

    def __getstate__(self) -> dict[str, Any]:
        """All numbers of the draws, without the engine."""
        for name in ("values", "positions", "_scores"):
            getattr(self, name)
        return {**self.__dict__, "_trajectories": None}

    def _of_each(self, look: Callable[[_engine.Trajectories, int], Any]) -> list[Any]:
        """The engine's results of each chain; pickling reads what it needs before."""
        assert self._trajectories is not None
        return [look(self._trajectories, chain) for chain in range(len(self.sizes))]

    @cached_property
    def values(self) -> list[dict[str, Reals]]:
        """Of each chain the values of its continuous choices by address: (draws,) or (draws, n)."""

        def by_address(found: _engine.Trajectories, chain: int) -> dict[str, Reals]:
            choices = found.choices(chain)
            ends = np.cumsum([choice.width for choice in choices])[:-1]
            parts = np.split(found.values(chain), ends, axis=1)
            return {
                choice.name: part if choice.is_vector else part[:, 0]
                for choice, part in zip(choices, parts, strict=True)
            }

        return self._of_each(by_address)

    @cached_property
    def draws(self) -> dict[str, Reals]:
        """Values of the continuous choices by address, of those that all chains have: as `Result.draws`."""
        least = min(self.sizes)
        return together([{path: x[:least] for path, x in chain.items()} for chain in self.values])

    def choices(self, chain: int, draw: int) -> dict[str, Any]:
        """Every choice of a draw by its address."""
        values = {path: part[draw] for path, part in self.values[chain].items()}
        numbers = {path: tuple(x) if isinstance(x, np.ndarray) else x.item() for path, x in values.items()}
        return {**self.fixed[chain], **numbers}

    @cached_property
    def _scores(self) -> list[tuple[Reals, Reals]]:
        """Log prior and log score of each chain's draws: each draw is run for them, when they are first read."""
        with translated(self.search.model.name, f"seed={self.seed}"):
            return self._of_each(lambda found, chain: found.scores(chain))

    @property
    def log_prior(self) -> Reals:
        """Of the choices of each draw, (chains, draws), nats, as for any sample."""
        return np.array([prior[: min(self.sizes)] for prior, _ in self._scores])

    @property
    def log_score(self) -> Reals:
        """Of factors and observations of each draw, (chains, draws), nats, as for any sample."""
        return np.array([score[: min(self.sizes)] for _, score in self._scores])

    @property
    def best_draw(self) -> int:
        """The place of the draw of the best log score."""
        return int(np.concatenate([score for _, score in self._scores]).argmax())

    @cached_property
    def positions(self) -> list[Reals]:
        """The coordinates of each chain's draws, (draws, dim); see `niwaki.log_density`."""
        return self._of_each(lambda found, chain: found.positions(chain))

    def statistics(self) -> dict[str, NDArray[Any]]:
        """Numbers of each draw by the names that ArviZ knows, (chains, draws)."""
        step = np.broadcast_to(self.step_size[:, None], self.log_density.shape)
        return {**self.stats, "lp": self.log_density, "step_size": step}

    def warn(self, method: Hmc | Nuts) -> None:
        """Warn about what affects the use of the draws: fixed choices, and trajectories that broke off."""
        name, broke = self.search.model.name, self.divergences
        held = sorted({path for fixed in self.fixed for path in fixed})
        if held:
            say(kept(held, name))
        trajectories = sum(self.sizes) * method.thin
        figures = isinstance(method, Nuts) or not method.designs
        if broke.structure and figures:
            kernel = "nuts_step" if isinstance(method, Nuts) else "hmc_step"
            say(
                f"{refused(broke.structure, trajectories, name)}; each chain keeps the structure of its start, so the "
                f"draws are given that structure and are not those of the whole model; use instead "
                f"`mh(kernel=kernels.cycle(kernels.prior(), kernels.{kernel}()))`, with `from niwaki import kernels`"
            )
        if broke.energy and figures:
            smaller = (
                f"raise `target_accept`, which is {method.target_accept:g}"
                if method.step_size is None
                else f"take a smaller `step_size` than {method.step_size:g}"
            )
            say(diverged(broke.energy, trajectories, name, smaller))
        # A few trajectories that overshoot into overflow are harmless: they are rejected.
        if broke.not_finite > SOME * trajectories:
            say(without_slope(broke.not_finite, name, self.fault))
