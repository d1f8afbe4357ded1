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
    start_time = time.process_time()
    draws_found, accepted = original.hmc(partial(height, density), x, draws, steps, seed)
    spent = time.process_time() - start_time
    heights = np.array([[density(x) for x in draws_found]])
    return Chains(draws_found[None], draws * steps, spent, accepted, heights)


def ours(seed: int) -> Chains:
    """Our default sampler on one thread."""
    start_time = time.process_time()
    result = nw.run(stacks.stack, width=WIDTH, method=nw.explore(), seed=seed, threads=1)
    spent = time.process_time() - start_time
    accepted = float(result.stats["acceptance_rate"].mean())
    return Chains(np.array(result.positions), result.gradients, spent, accepted, result.log_density)


def level(draws: int) -> float:
    """The median log density of a long chain, in a metric that suits it."""
    density, x = stacks.start(stacks.stack, seed=1, width=WIDTH)
    method = nw.nuts(draws=draws, warmup=draws, chains=1, metric="low-rank")
    result = nw.run(stacks.stack, width=WIDTH, method=method, choices=density.values(x), seed=1, threads=1)
    return float(np.median(result.log_density))
