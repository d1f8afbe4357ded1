"""Chains that follow the gradient: no-U-turn trajectories in a low-rank metric, frozen after the warm-up.

Each chain starts where `niwaki.stacks.start` finds a balance from its own seed.
"""

from __future__ import annotations

import time
import warnings

import niwaki as nw
import numpy as np
from niwaki import stacks

from stacking.files import Drawn
from stacking.kinds import Kind

WARMUP = 300
#: Transitions for each draw; up to 1023 leapfrog steps each.
THIN = 5


def draw(kind: Kind, chain: int, draws: int, warmup: int = WARMUP, thin: int = THIN) -> Drawn:
    """Draws of one chain."""
    start = time.process_time()
    density, x = stacks.start(kind.model, 100 * chain + 1, kind.width)
    started = time.process_time()
    method = nw.nuts(draws=draws, warmup=warmup, thin=thin, chains=1, metric="low-rank")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = nw.run(kind.model, method, seed=100 * chain + 1, width=kind.width, choices=density.values(x))
    spent = time.process_time() - started
    addresses = list(result.draws)
    values = np.array([result.draws[name][0] for name in addresses]).T
    # Seconds of warm-up and draws by their gradients, which all cost the same.
    after = int(result.stats["n_steps"].sum()) * thin
    share = min(1.0, after / result.gradients)
    return Drawn(
        addresses,
        values,
        started - start,
        (1.0 - share) * spent,
        share * spent,
        after,
        float(result.stats["acceptance_rate"].mean()),
        result.divergences.total,
        f"nuts, low-rank metric, warm-up {warmup}, every {thin}th",
    )
