"""Draws that are stored as numbers: draws of chains that follow a gradient, and of normals.

A draw becomes a `Sample`, with scene and choices, when it is read.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.lang.compiled import translated
from niwaki.once import cached_property
from niwaki.result.diagnostics import together
from niwaki.result.info import Info, S
from niwaki.result.sample import Sample
from niwaki.result.search_like import SearchLike

Reals = NDArray[np.float64]


class Engine(Protocol):
    """Interface of the engine to such draws, by chain."""

    def choices(self, chain: int) -> list[_engine.Coordinates]:
        """The continuous choices."""

    def values(self, chain: int) -> Reals:
        """Their values, (draws, numbers)."""

    def positions(self, chain: int) -> Reals:
        """Coordinates of the draws, (draws, dim)."""

    def scores(self, chain: int) -> tuple[Reals, Reals]:
        """Log prior and log score of each draw, nats."""


class Drawn(Sequence[Sample]):
    """Draws as samples, chain by chain: a replay of the model makes a sample when it is read."""

    def __init__(self, info: DrawnInfo, seconds: tuple[float, float]) -> None:
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
        sample = Sample.of_trace(trace, info.search, info.seed, *self._seconds)
        if info.log_weights is not None:
            sample.log_weight = float(info.log_weights[place])
        return sample

    def __iter__(self) -> Iterator[Sample]:
        return (self[place] for place in range(len(self)))


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class DrawnInfo(Info):
    """Statistics of methods that store draws as numbers.

    Attributes
    ----------
    search, seed
        The search, and its seed.
    sizes : tuple of int
        The number of draws of each chain or normal.
    fixed : list of dict
        The fixed choices of each chain or normal, by address.
    log_weights : array of shape (n,) or None
        Logs of the weights of all draws; None for equal weights.
    """

    search: SearchLike
    seed: int
    sizes: tuple[int, ...]
    fixed: list[dict[str, Any]]
    log_weights: Reals | None = None
    _engine: Engine | None = None

    def statistics(self) -> dict[str, NDArray[Any]]:
        """Numbers of each draw by the names that ArviZ knows, (chains, draws)."""
        raise NotImplementedError

    def _draws(self) -> dict[str, Reals]:
        return self.draws

    def _statistics(self) -> dict[str, NDArray[Any]]:
        return self.statistics()

    def _log_weights(self) -> Reals:
        return np.zeros(sum(self.sizes)) if self.log_weights is None else self.log_weights

    def _pool(self, samples: Sequence[S]) -> Sequence[S]:
        return [samples[self.best_draw]] if len(samples) else samples

    def __getstate__(self) -> dict[str, Any]:
        """The numbers of the draws for pickling, without the engine."""
        for name in ("values", "positions", "_scores"):
            getattr(self, name)
        return {**self.__dict__, "_engine": None}

    def _of_each(self, look: Callable[[Engine, int], Any]) -> list[Any]:
        """Read a result of each chain from the engine."""
        assert self._engine is not None
        return [look(self._engine, chain) for chain in range(len(self.sizes))]

    @cached_property
    def values(self) -> list[dict[str, Reals]]:
        """Values of the continuous choices by address, for each chain: (draws,) or (draws, n)."""

        def by_address(engine: Engine, chain: int) -> dict[str, Reals]:
            choices = engine.choices(chain)
            ends = np.cumsum([choice.width for choice in choices])[:-1]
            parts = np.split(engine.values(chain), ends, axis=1)
            return {
                choice.name: part if choice.is_vector else part[:, 0]
                for choice, part in zip(choices, parts, strict=True)
            }

        return self._of_each(by_address)

    @cached_property
    def draws(self) -> dict[str, Reals]:
        """Values of the continuous choices that all chains have, by address: as `Result.draws`."""
        least = min(self.sizes)
        return together([{path: x[:least] for path, x in chain.items()} for chain in self.values])

    def choices(self, chain: int, draw: int) -> dict[str, Any]:
        """Every choice of a draw by its address."""
        values = {path: part[draw] for path, part in self.values[chain].items()}
        numbers = {path: tuple(x) if isinstance(x, np.ndarray) else x.item() for path, x in values.items()}
        return {**self.fixed[chain], **numbers}

    @cached_property
    def _scores(self) -> list[tuple[Reals, Reals]]:
        """Log prior and log score of each chain's draws, from a run of each draw at the first read."""
        with translated(self.search.model.name, f"seed={self.seed}"):
            return self._of_each(lambda engine, chain: engine.scores(chain))

    @property
    def log_prior(self) -> Reals:
        """The log prior of each draw, (chains, draws), nats, as for any sample."""
        return np.array([prior[: min(self.sizes)] for prior, _ in self._scores])

    @property
    def log_score(self) -> Reals:
        """The log score of each draw, (chains, draws), nats, as for any sample."""
        return np.array([score[: min(self.sizes)] for _, score in self._scores])

    @property
    def best_draw(self) -> int:
        """The place of the draw with the best log score."""
        return int(np.concatenate([score for _, score in self._scores]).argmax())

    @cached_property
    def positions(self) -> list[Reals]:
        """The coordinates of each chain's draws, (draws, dim); see `niwaki.log_density`."""
        return self._of_each(lambda engine, chain: engine.positions(chain))
