"""Chains that stack six blocks on one another: the original's HMC with its settings, and ours.

The original's: 200 draws with 1000 steps, from the balance of `niwaki.stacks.start`. Ours: `niwaki.explore()` with its
defaults, from runs of the prior.
"""

import time
from functools import partial

import niwaki as nw
import numpy as np
import original
from chains_of_numbers import Chains
from niwaki import stacks
from niwaki.stacks.starts import height

DRAWS, STEPS, WIDTH = 200, 1000, 0.005


def originals(seed: int, draws: int = DRAWS, steps: int = STEPS) -> Chains:
    """The original's chain."""
    density, x = stacks.start(stacks.stack, seed=seed, width=WIDTH)
    begun = time.process_time()
    found, accepted = original.hmc(partial(height, density), x, draws, steps, seed)
    spent = time.process_time() - begun
    heights = np.array([[density(x) for x in found]])
    return Chains(found[None], draws * steps, spent, accepted, heights)


def ours(seed: int) -> Chains:
    """Our default sampler on one thread."""
    begun = time.process_time()
    found = nw.run(stacks.stack, width=WIDTH, method=nw.explore(), seed=seed, threads=1)
    spent = time.process_time() - begun
    accepted = float(found.stats["acceptance_rate"].mean())
    return Chains(np.array(found.positions), found.gradients, spent, accepted, found.log_density)


def level(draws: int) -> float:
    """The median log density of a long chain, in a metric that suits it."""
    density, x = stacks.start(stacks.stack, seed=1, width=WIDTH)
    method = nw.nuts(draws=draws, warmup=draws, chains=1, metric="low-rank")
    found = nw.run(stacks.stack, width=WIDTH, method=method, choices=density.values(x), seed=1, threads=1)
    return float(np.median(found.log_density))
