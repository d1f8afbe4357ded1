"""Chains that color our four drawings: the original's two samplers with its settings, and ours.

The original's: 2000 proposals of single-site MH from a run of the prior, then 1000 draws of HMC with 100 steps, or of
MH 200 proposals apart. Ours: `niwaki.explore()` with its defaults.
"""

import time
from functools import cache
from typing import Any

import niwaki as nw
import numpy as np
import original
from chains_of_numbers import Chains
from niwaki.color import Drawing, coloring
from niwaki.color.search import arguments, rules_of

DRAWINGS = ("robot", "house", "bug", "rocket")
DRAWS, STEPS, BURN_IN = 1000, 100, 2000
UNIT = (0.0, 1.0)


@cache
def task(name: str) -> tuple[Drawing, tuple[Any, ...]]:
    """A drawing of ours, and what the model takes for it."""
    drawing = Drawing.load(name)
    return drawing, arguments(drawing, rules_of(name))


@cache
def originals(name: str, seed: int, draws: int = DRAWS) -> dict[str, Chains]:
    """Both samplers of the original, from one burn-in."""
    drawing, arguments = task(name)
    density = nw.log_density(nw.run(coloring, *arguments, seed=seed).best)
    density.compile()
    ask, draws_by_name = density.value_and_gradient, {}
    burnt, _ = original.mh(ask, density.start, BURN_IN, seed, UNIT)
    proposals = 2 * STEPS * draws
    samplers = {
        "HMC": (STEPS * draws, lambda: original.hmc(ask, burnt[-1], draws, STEPS, seed)),
        "MH": (proposals, lambda: original.mh(ask, burnt[-1], proposals, seed, UNIT, thin=2 * STEPS)),
    }
    for sampler, (evaluations, make) in samplers.items():
        start = time.process_time()
        coordinates, accepted = make()
        spent = time.process_time() - start
        colors = 1.0 / (1.0 + np.exp(-coordinates.reshape(1, draws, len(drawing.names), 3)))
        heights = np.array([ask(x)[0] for x in coordinates])
        draws_by_name[sampler] = Chains(colors, evaluations, spent, accepted, heights)
    return draws_by_name


@cache
def ours(name: str, seed: int, chains: int | None = None) -> Chains:
    """Our default sampler on one thread; as many chains as it takes by default."""
    method = nw.explore() if chains is None else nw.explore(chains=chains)
    return timed(name, method, seed)


@cache
def level(name: str, warmup: int = 300) -> float:
    """The median log density where chains have forgotten their starts: those of `explore`, after a long warm-up."""
    return float(
        np.median(timed(name, nw.explore(draws=20, chains=64, warmup=warmup, steps=60), 1).log_density)
    )


@cache
def timed(name: str, method: Any, seed: int) -> Chains:
    """A gradient sampler of the engine on one thread."""
    drawing, arguments = task(name)
    start = time.process_time()
    result = nw.run(coloring, *arguments, method=method, seed=seed, threads=1)
    spent = time.process_time() - start
    colors = np.stack(list(result.draws.values()), axis=-1)
    shape = (*colors.shape[:2], len(drawing.names), 3)
    accepted = float(result.stats["acceptance_rate"].mean())
    return Chains(colors.reshape(shape), result.gradients, spent, accepted, result.log_density)
