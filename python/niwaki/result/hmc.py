"""What chains that follow a gradient give back: draws by address, their diagnostics, and each draw as a sample.

Draws are kept as numbers; a draw becomes a `Sample`, with scene and choices, when it is asked for.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.lang.compiled import as_fault, translated
from niwaki.methods import Hmc, Nuts
from niwaki.result.diagnostics import Divergences, Summaries, summarise
from niwaki.result.result import Result, Sample

if TYPE_CHECKING:
    from niwaki.search import Search

Reals = NDArray[np.float64]

#: The share of trajectories without a finite gradient from which on a person is told.
SOME = 0.01


class GradientWarning(UserWarning):
    """Chains that follow a gradient gave draws, but not of all that was asked for."""


def say(text: str) -> None:
    """Warn whoever asked for the draws, at the line of their own code."""
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
    """What becomes of discrete choices where all follows the gradient."""
    many = len(paths) > 1
    return (
        f"{len(paths)} discrete choice{'s' if many else ''} of `{name}` kept the value of each "
        f"chain's start, because a gradient does not move {'them' if many else 'it'}: {listed(paths)}; "
        f"draws are conditional on {'those values' if many else 'that value'}; "
        f"use `mh()` where {'they' if many else 'it'} should vary"
    )


def refused(count: int, trajectories: int, name: str) -> str:
    """What being refused for structure is."""
    return (
        f"{count} of {trajectories} trajectories of `{name}` after the warm-up were refused for structure: "
        f"the model makes other choices at the points that they reached, and a gradient cannot change the structure"
    )


def diverged(count: int, trajectories: int, name: str, smaller: str) -> str:
    """What a divergence is, and what helps; `smaller` says how to get a smaller step."""
    return (
        f"{count} of {trajectories} trajectories of `{name}` after the warm-up diverged: the step is too large where "
        f"the density bends sharply, and the draws may miss such places; {smaller}, or reparametrise: instead of "
        f"`gaussian(mean, spread)` with a `spread` that is a choice itself, write `mean + spread * gaussian(0, 1)`"
    )


def without_slope(count: int, name: str, fault: ModelFault | None) -> str:
    """Where a gradient was no number; without a fault the coordinates were none either."""
    why = (
        f"the first:\n{fault.render()}"
        if fault
        else "they left the range of numbers: give the values other units"
    )
    return (
        f"{count} trajectories of `{name}` reached points without a finite gradient and were rejected; {why}"
    )


class Drawn(Sequence[Sample]):
    """Samples that are made when they are asked for, those of the first chain first."""

    def __init__(self, sizes: Sequence[int], make: Callable[[int, int], Sample]) -> None:
        self._ends = np.cumsum(sizes, dtype=np.int64)
        self._make = make

    def __len__(self) -> int:
        return int(self._ends[-1]) if len(self._ends) else 0

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[place] for place in range(*index.indices(len(self)))]
        place = index + len(self) if index < 0 else index
        if not 0 <= place < len(self):
            raise IndexError("no such sample")
        chain = int(np.searchsorted(self._ends, place, side="right"))
        return self._make(chain, place - (int(self._ends[chain - 1]) if chain else 0))

    def __iter__(self) -> Iterator[Sample]:
        return (self[place] for place in range(len(self)))


class HmcResult(Result):
    """Draws of chains that follow the gradient; a sequence of samples, chain after chain.

    Chains that were stopped may have different lengths; arrays (chains, draws) then hold as many draws as the shortest.

    Attributes
    ----------
    samples : sequence of Sample
        Every draw after the warm-up; all weigh the same. Each is made by a run of the model when it is asked for.
    draws : dict of str to array
        Values of the continuous choices by address, (chains, draws) or (chains, draws, n) for lists of n numbers, of
        the choices that all chains have.
    log_density : array of shape (chains, draws)
        Over the coordinates in which the chains move, Jacobians included, nats.
    log_prior, log_score : array of shape (chains, draws)
        Of choices, and of factors and observations, nats, as for any sample; found when they are asked for.
    stats : dict of str to array
        Of each draw, (chains, draws): `energy` (nats), `acceptance_rate`, `n_steps`, `tree_depth`, and
        whether a trajectory on the way to it was refused for structure (`refused_for_structure`) or broke off for
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
        With its line: what the first trajectory met that came to a point without a finite gradient.
    """

    def __init__(
        self,
        search: Search,
        method: Hmc | Nuts,
        counted: _engine.Task,
        found: _engine.Trajectories,
        seed: int,
        seconds: float,
        cpu_seconds: float,
    ) -> None:
        super().__init__(search, [], seed, interrupted=found.interrupted, invalid=counted.invalid())
        self.seconds, self.cpu_seconds = seconds, cpu_seconds
        self._method, self._found = method, found
        chains = range(method.chains)
        rows = [found.draws(chain) for chain in chains]
        counts = [found.counters(chain) for chain in chains]
        sizes = [len(row["energy"]) for row in rows]
        self._sizes, self._least = sizes, min(sizes)
        self.samples = Drawn(sizes, self._sample)  # type: ignore[assignment]

        def together(name: str) -> NDArray[Any]:
            return np.array([row[name][: self._least] for row in rows])

        self.log_density: Reals = together("log_density")
        self.stats: dict[str, NDArray[Any]] = {
            "energy": together("energy"),
            "acceptance_rate": together("accept"),
            "n_steps": together("steps"),
            "tree_depth": together("depth"),
            "diverging": together("diverging"),
            "refused_for_structure": together("off_structure"),
        }
        self.step_size: Reals = np.array([count["step_size"] for count in counts])
        self.gradients: int = sum(count["gradients"] + count["warmup_gradients"] for count in counts)
        self.divergences = Divergences(
            *(
                sum(count[name] for count in counts)
                for name in ("energy", "guard", "impossible", "not_finite")
            )
        )
        self.fixed: list[dict[str, Any]] = [
            {path: value for path, _, value in found.fixed(chain)} for chain in chains
        ]
        faults = (found.fault(chain) for chain in chains)
        first = next((fault for fault in faults if fault is not None), None)
        self.fault = as_fault(first, self.model.name, f"seed={self.seed}")

    @property
    def method(self) -> Hmc | Nuts:
        """How its chains move."""
        return self._method

    @property
    def by_chain(self) -> list[Sequence[Sample]]:
        """The draws of each chain as samples."""
        ends = np.cumsum([0, *self._sizes])
        return [self.samples[int(a) : int(b)] for a, b in zip(ends, ends[1:], strict=False)]

    def __getstate__(self) -> dict[str, Any]:
        """All numbers of the draws; a draw becomes a sample again by a run with its choices."""
        for name in ("draws", "_scores", "positions", "_values"):
            getattr(self, name)
        kept = {name: value for name, value in self.__dict__.items() if name != "samples"}
        return {**kept, "_found": None}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self.samples = Drawn(self._sizes, self._sample)  # type: ignore[assignment]

    @cached_property
    def _values(self) -> list[dict[str, Reals]]:
        """Of each chain the values of its continuous choices by address: (draws,) or (draws, n)."""
        by_chain: list[dict[str, Reals]] = []
        for chain in range(self.method.chains):
            values, found, at = self._found.values(chain), {}, 0
            for path, _, _, _, _, width, is_vector in self._found.choices(chain):
                part = values[:, at : at + width]
                found[path] = part if is_vector else part[:, 0]
                at += width
            by_chain.append(found)
        return by_chain

    def _sample(self, chain: int, draw: int) -> Sample:
        values = {path: part[draw] for path, part in self._values[chain].items()}
        numbers = {path: tuple(x) if isinstance(x, np.ndarray) else x.item() for path, x in values.items()}
        choices = {**self.fixed[chain], **numbers}
        with translated(self.model.name, f"seed={self.seed}", choices):
            trace = self.search.task.replay(choices)
        sample = Sample.of_trace(trace, self.search)
        sample.seed, sample.seconds, sample.cpu_seconds = self.seed, self.seconds, self.cpu_seconds
        return sample

    @cached_property
    def draws(self) -> dict[str, Reals]:
        """Values of the continuous choices by address, of those that all chains have."""
        by_chain = [{path: values[: self._least] for path, values in chain.items()} for chain in self._values]
        first = by_chain[0]
        common = [
            path
            for path in first
            if all(path in found and found[path].shape == first[path].shape for found in by_chain)
        ]
        return {path: np.array([found[path] for found in by_chain]) for path in common}

    @cached_property
    def _scores(self) -> list[tuple[Reals, Reals]]:
        """Log prior and log score of each chain's draws: each draw is run for them, when they are first asked for."""
        with translated(self.model.name, f"seed={self.seed}"):
            return [self._found.scores(chain) for chain in range(self.method.chains)]

    @property
    def log_prior(self) -> Reals:
        """Of the choices of each draw, (chains, draws), nats, as for any sample."""
        return np.array([prior[: self._least] for prior, _ in self._scores])

    @property
    def log_score(self) -> Reals:
        """Of factors and observations of each draw, (chains, draws), nats, as for any sample."""
        return np.array([score[: self._least] for _, score in self._scores])

    @cached_property
    def positions(self) -> list[Reals]:
        """The coordinates of each chain's draws, (draws, dim); see `niwaki.log_density`."""
        return [self._found.positions(chain) for chain in range(self.method.chains)]

    @property
    def best(self) -> Sample:
        """The draw of the best log score."""
        if not len(self.samples):
            raise InputError("no-runs", detail=repr(self))
        scores = [score for _, score in self._scores]
        chain = max(
            (chain for chain, score in enumerate(scores) if len(score)),
            key=lambda chain: float(scores[chain].max()),
        )
        return self._sample(chain, int(scores[chain].argmax()))

    def summary(self) -> Summaries:
        """Mean, deviation, standard error, effective sizes and R-hat of every number, and of the log density."""
        return summarise({**self.draws, "log density": self.log_density}, self.divergences)

    def _statistics(self) -> dict[str, NDArray[Any]]:
        step = np.broadcast_to(self.step_size[:, None], self.log_density.shape)
        return {**self.stats, "lp": self.log_density, "step_size": step}

    def warn(self) -> None:
        """Say what a person must know before using the draws: what was held fixed, what broke off."""
        name, broke = self.model.name, self.divergences
        held = sorted({path for fixed in self.fixed for path in fixed})
        if held:
            say(kept(held, name))
        trajectories = len(self) * self.method.thin
        figures = isinstance(self.method, Nuts) or not self.method.designs
        if broke.structure and figures:
            kernel = "nuts" if isinstance(self.method, Nuts) else "hmc"
            say(
                f"{refused(broke.structure, trajectories, name)}; each chain keeps the structure of its start, so the "
                f"draws are given that structure and are not those of the whole model; use instead "
                f"`mh(kernel=kernels.cycle(kernels.mh(), kernels.{kernel}()))`, with `from niwaki import kernels`"
            )
        if broke.energy and figures:
            smaller = (
                f"raise `target_accept`, which is {self.method.target_accept:g}"
                if self.method.step_size is None
                else f"take a smaller `step_size` than {self.method.step_size:g}"
            )
            say(diverged(broke.energy, trajectories, name, smaller))
        # A few trajectories that overshoot into overflow are of no consequence: they are rejected.
        if broke.not_finite > SOME * trajectories:
            say(without_slope(broke.not_finite, name, self.fault))

    def __repr__(self) -> str:
        chains = self.method.chains
        parts = [f"{chains} chain{'s' if chains > 1 else ''}", f"{len(self)} draws"]
        parts.append(f"{self.gradients} gradients")
        parts += self.divergences.named
        parts += [f"seed {self.seed}", f"{self.seconds:.2f} s"]
        parts += self._outside()
        if self.interrupted:
            parts.append("interrupted")
        return f"<HmcResult of {self.model.name}: {', '.join(parts)}>"
