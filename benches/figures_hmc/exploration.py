"""How much of a design space our default sampler reaches, beside the original's settings: per time and per gradient.

Colourings: `niwaki.explore()` with its defaults beside 1000 draws of HMC with 100 steps; then with as many chains as
use the same 100 000 gradients. The stack: its defaults beside 200 draws with 1000 steps. Effective draws are by the
autocorrelation of the whole vector with the chain's own mean, and the smallest bulk size of a coordinate. `below` is
how far under the level of a long run the median draw lies, and the lowest twentieth, nats: draws of
the warm-up phase also count as reached, so it must not be above that of the original. Means over seeds.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import chains_of_blocks as blocks
import coverage
import numpy as np
from chains_of_colors import DRAWINGS, DRAWS, STEPS, level, originals, ours
from chains_of_numbers import Chains

SEEDS = (1, 2, 3)


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Print and report a row for each drawing and sampler, then the stack's."""
    names, draws, seeds = (("bug",), 40, SEEDS[:1]) if quick else (DRAWINGS, DRAWS, SEEDS)
    print(f"{'design':8} {'sampler':22} gradients    cpu s   bins  effective   least   below")
    for name in names:
        chains_of_name = ours(name, seeds[0])
        as_many = max(1, round(chains_of_name.values.shape[0] * STEPS * draws / chains_of_name.gradients))
        samplers = {
            "HMC as the original": [originals(name, seed, draws)["HMC"] for seed in seeds],
            "explore": [ours(name, seed) for seed in seeds],
            "explore, as many": [ours(name, seed, as_many) for seed in seeds],
        }
        high = level(name, 20 if quick else 300)
        for sampler, chains_of_sampler in samplers.items():
            tell(shown(name, sampler, chains_of_sampler, high, reach(chains_of_sampler)))
    steps = {"draws": 20, "steps": 50} if quick else {}
    samplers = {
        "HMC as the original": [blocks.originals(seed, **steps) for seed in seeds],
        "explore": [blocks.ours(seed) for seed in seeds],
    }
    high = blocks.level(30 if quick else 500)
    for sampler, chains_of_sampler in samplers.items():
        tell(shown("stack", sampler, chains_of_sampler, high))


def reach(chains_of_sampler: list[Chains]) -> float:
    """Bins of CIELAB that a region's draws reach, the mean over regions and seeds."""
    return float(np.mean([coverage.reached(chains.all_draws).mean() for chains in chains_of_sampler]))


def shown(
    design: str, sampler: str, chains_of_sampler: list[Chains], high: float, bins: float | None = None
) -> dict[str, Any]:
    """A row for one sampler on one design, whose long run lies at `high` nats: means over seeds, printed."""
    below = np.mean(
        [high - np.quantile(chains.log_density, (0.5, 0.05)) for chains in chains_of_sampler], axis=0
    )
    line = {
        "design": design,
        "sampler": sampler,
        "gradients": round(float(np.mean([chains.gradients for chains in chains_of_sampler]))),
        "cpu": round(float(np.mean([chains.cpu for chains in chains_of_sampler])), 3),
        "bins": None if bins is None else round(bins, 1),
        "effective": round(float(np.mean([chains.effective for chains in chains_of_sampler])), 1),
        "least": round(float(np.mean([chains.least for chains in chains_of_sampler])), 1),
        "below": [round(float(nats)) for nats in below],
    }
    print(
        f"{design:8} {sampler:22} {line['gradients']:9} {line['cpu']:8.2f} {line['bins'] or '-':>6}"
        f" {line['effective']:10.1f} {line['least']:7.1f}   {line['below'][0]}, {line['below'][1]}",
        flush=True,
    )
    return line
