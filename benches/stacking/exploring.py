"""Many short chains: `niwaki.explore()` with its defaults, the last draw of each chain, each from its own run."""

from __future__ import annotations

import time

import niwaki as nw
import numpy as np

from stacking.files import Drawn
from stacking.kinds import Kind


def draw(kind: Kind, chain: int, draws: int) -> Drawn:
    """The last draws of so many chains; `chain` decides their seed."""
    start = time.process_time()
    result = nw.run(
        kind.model, method=nw.explore(chains=draws), seed=100 * chain + 1, width=kind.width, threads=1
    )
    spent = time.process_time() - start
    values = np.array([numbers[:, -1] for numbers in result.draws.values()]).T
    accepted = float(result.stats["acceptance_rate"].mean())
    figures = (0.0, 0.0, spent, result.gradients, accepted, result.divergences.total)
    return Drawn(list(result.draws), values, *figures, "explore, the last of each chain")
