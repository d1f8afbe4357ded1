"""Effective sample sizes of a sampler's draws, of colors and of blocks."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from niwaki import diagnostics


@dataclass(frozen=True)
class Chains:
    """Draws of one sampler.

    Attributes
    ----------
    values
        (chains, draws, ...): colors as (regions, 3) in [0, 1], other choices as coordinates.
    gradients
        Gradients, or evaluations for MH, burn-in and warm-up included.
    cpu
        Seconds, the first run of the model and machine code included.
    accepted
        The share of proposals.
    log_density
        Of each draw, over coordinates, nats.
    """

    values: Any
    gradients: int
    cpu: float
    accepted: float
    log_density: Any

    @property
    def effective(self) -> float:
        """Effective draws by the vector autocorrelation."""
        return diagnostics.ess_vector(self._flat())

    @property
    def least(self) -> float:
        """The smallest bulk effective size of a coordinate.

        Of several chains at most the size that their means give as independent numbers: halves of a short chain
        that hardly moved would count as two.
        """
        flat = self._flat()
        sizes = [diagnostics.ess_bulk(flat[:, :, k]) for k in range(flat.shape[2])]
        if len(flat) > 1:
            effective = len(flat) * flat.var(axis=(0, 1), ddof=1) / flat.mean(axis=1).var(axis=0, ddof=1)
            sizes = np.minimum(sizes, effective).tolist()
        return float(min(sizes))

    @property
    def all_draws(self) -> Any:
        """(draws of all chains, ...)."""
        return self.values.reshape(-1, *self.values.shape[2:])

    def _flat(self) -> Any:
        return self.values.reshape(*self.values.shape[:2], -1)
