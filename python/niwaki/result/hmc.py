"""Results of chains that follow a gradient: statistics of their trajectories, and warnings about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.errors import ModelFault
from niwaki.errors.warned import warn
from niwaki.lang.compiled import as_fault
from niwaki.methods import Hmc, Nuts
from niwaki.result import diagnostics
from niwaki.result.diagnostics import Divergences
from niwaki.result.drawn import DrawnInfo
from niwaki.result.search_like import SearchLike

Reals = NDArray[np.float64]

#: The share of trajectories without a finite gradient above which there is a warning.
SOME = 0.01


class GradientWarning(UserWarning):
    """A method that follows a gradient did not move every choice, or may have missed a part of the distribution."""


def say(text: str) -> None:
    """Warn at the line of the user's code that started the search."""
    warn(text, GradientWarning)


def _with_word(path: str, fixed: Sequence[Mapping[str, Any]]) -> str:
    """Return the address of a fixed choice, with its word if it has the same word in all chains."""
    values = {choices.get(path) for choices in fixed}
    word = values.pop() if len(values) == 1 else None
    return f"{path} = {word!r}" if isinstance(word, str) else path


def listed(paths: Sequence[str]) -> str:
    """List the first five choices."""
    return ", ".join(f"`{path}`" for path in paths[:5]) + (
        f" and {len(paths) - 5} more" if len(paths) > 5 else ""
    )


def fixed_choices(paths: Sequence[str], name: str, mover: str = "gradient", cure: str = "use `mh()`") -> str:
    """Word the warning that discrete choices kept their values, because a `mover` alone does not move them."""
    many = len(paths) > 1
    return (
        f"{len(paths)} discrete choice{'s' if many else ''} of `{name}` kept the value of each "
        f"chain's start, because a {mover} does not move {'them' if many else 'it'}: {listed(paths)}; "
        f"draws are conditional on {'those values' if many else 'that value'}; "
        f"{cure} where {'they' if many else 'it'} should vary"
    )


def other_structures(count: int, trajectories: int, name: str) -> str:
    """Word the warning that trajectories were rejected, because they reached another structure."""
    return (
        f"{count} of {trajectories} trajectories of `{name}` after the warm-up were refused for structure: "
        f"they reached points at which the model makes other choices, and a gradient cannot change the structure"
    )


def divergent(count: int, trajectories: int, name: str, smaller: str) -> str:
    """Word the warning that trajectories diverged; `smaller` describes how to get a smaller step."""
    return (
        f"{count} of {trajectories} trajectories of `{name}` after the warm-up diverged: the step is too large where "
        f"the density bends sharply, and the draws may miss such places; {smaller}, or reparametrise: instead of "
        f"`gaussian(mean, spread)` with a `spread` that is a choice itself, write `mean + spread * gaussian(0, 1)`"
    )


def without_gradient(count: int, name: str, fault: ModelFault | None) -> str:
    """Word the warning that gradients were not finite; without a fault, the coordinates were not finite either."""
    why = (
        f"the first:\n{fault.render()}"
        if fault
        else "their coordinates left the range of numbers: give the values other units"
    )
    return (
        f"{count} trajectories of `{name}` reached points without a finite gradient and were rejected; {why}"
    )


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class HmcInfo(DrawnInfo):
    """Statistics of `hmc`, `nuts` and `explore`: the draws as numbers, and statistics of the trajectories.

    Chains that were stopped may have different lengths. Arrays (chains, draws) then hold as many draws as the shortest.

    Attributes
    ----------
    search, seed, fixed, sizes
        As in `DrawnInfo`.
    log_density : array of shape (chains, draws)
        The log density over the coordinates in which the chains move, with Jacobians, nats.
    stats : dict of str to array
        Statistics of each draw, (chains, draws): `energy` (nats), `acceptance_rate`, `n_steps`, `tree_depth`, and
        whether a trajectory since the draw before was rejected for another structure (`refused_for_structure`) or broke
        off for another reason (`diverging`).
    step_size : array of shape (chains,)
        The step sizes at the end of the warm-up.
    divergences : Divergences
        Trajectories of all chains that broke off after the warm-up, by the reason: `structure` counts those that
        reached another structure, `energy` those that diverged.
    gradients : int
        The number of gradients, with the warm-up.
    fault : ModelFault or None
        The fault, with its line, of the first trajectory that reached a point without a finite gradient.
    """

    _HAS_CHAINS = True

    log_density: Reals
    stats: dict[str, NDArray[Any]]
    step_size: Reals
    divergences: Divergences
    gradients: int
    fault: ModelFault | None

    @classmethod
    def of(cls, search: SearchLike, seed: int, trajectories: _engine.Trajectories) -> HmcInfo:
        """Read the results of chains from the engine."""
        chains = range(trajectories.chains)
        draws = [trajectories.draws(chain) for chain in chains]
        counts = [trajectories.counters(chain) for chain in chains]
        sizes = tuple(len(numbers["energy"]) for numbers in draws)
        stats = {name: np.array([numbers[name][: min(sizes)] for numbers in draws]) for name in draws[0]}
        faults = (trajectories.fault(chain) for chain in chains)
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
            fixed=[{choice.path: choice.value for choice in trajectories.fixed(chain)} for chain in chains],
            fault=as_fault(first, search.model.name, f"seed={seed}"),
            _engine=trajectories,
        )

    def _summary(self) -> diagnostics.Summaries:
        return diagnostics.summarise({**self.draws, "log density": self.log_density}, self.divergences)

    def _repr_parts(self, samples: str) -> list[str]:
        return [samples, f"{self.gradients} gradients", *self.divergences.named]

    def statistics(self) -> dict[str, NDArray[Any]]:
        """Numbers of each draw by the names that ArviZ knows, (chains, draws)."""
        step = np.broadcast_to(self.step_size[:, None], self.log_density.shape)
        return {**self.stats, "lp": self.log_density, "step_size": step}

    def warn(self, method: Hmc | Nuts) -> None:
        """Warn about fixed choices, and about trajectories that broke off."""
        name, broke = self.search.model.name, self.divergences
        held = sorted({path for fixed in self.fixed for path in fixed})
        if held:
            say(fixed_choices([_with_word(path, self.fixed) for path in held], name))
        trajectories = sum(self.sizes) * method.thin
        figures = isinstance(method, Nuts) or not method.designs
        if broke.structure and figures:
            kernel = "nuts_step" if isinstance(method, Nuts) else "hmc_step"
            say(
                f"{other_structures(broke.structure, trajectories, name)}; each chain keeps the structure of its "
                f"start, so the draws are given that structure and are not those of the whole model; use instead "
                f"`mh(kernel=kernels.cycle(kernels.prior(), kernels.{kernel}()))`, with `from niwaki import kernels`"
            )
        if broke.energy and figures:
            smaller = (
                f"raise `target_accept`, which is {method.target_accept:g}"
                if method.step_size is None
                else f"take a smaller `step_size` than {method.step_size:g}"
            )
            say(divergent(broke.energy, trajectories, name, smaller))
        # A few trajectories that overshoot into overflow are harmless: they are rejected.
        if broke.not_finite > SOME * trajectories:
            say(without_gradient(broke.not_finite, name, self.fault))
