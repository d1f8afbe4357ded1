"""What our default sampler sees of a design space beside the original's settings, in little time and per gradient.

Colourings: `niwaki.explore()` as it stands, about 0.2 s of one thread, beside 1000 draws of HMC with 100 steps; then
with as many chains as spend the same 100 000 gradients. The stack: 2 s beside 200 draws with 1000 steps. Effective
draws are by the autocorrelation of the whole vector with the chain's own mean, and the smallest bulk size of a
coordinate. `below` is how far under the level of a long run the median draw lies, and the lowest twentieth, nats: what
a sampler sees on its way there counts as seen too, so it must not be more than the original counts. Means over seeds.
"""

import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import coverage
import niwaki as nw
import numpy as np
import original
from chains_of_colors import DRAWINGS, DRAWS, STEPS, Chains, level, originals, ours
from niwaki import diagnostics, stacks
from niwaki.errors import ModelFault

SEEDS = (1, 2, 3)
STACK_DRAWS, STACK_STEPS, STACK_WIDTH = 200, 1000, 0.005


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Print and tell a row for each drawing and sampler, then the stack's."""
    names, draws, seeds = (("bug",), 40, SEEDS[:1]) if quick else (DRAWINGS, DRAWS, SEEDS)
    print(f"{'design':8} {'sampler':22} gradients    cpu s   bins  effective   least   below")
    for name in names:
        own = ours(name, seeds[0])
        as_many = max(1, round(own.colors.shape[0] * STEPS * draws / own.gradients))
        rows = {
            "HMC as the original": [originals(name, seed, draws)["HMC"] for seed in seeds],
            "explore": [ours(name, seed) for seed in seeds],
            "explore, as many": [ours(name, seed, as_many) for seed in seeds],
        }
        for way, made in rows.items():
            tell(told(name, way, made, level(name, 20 if quick else 300)))
    for line in stack(20 if quick else STACK_DRAWS, 50 if quick else STACK_STEPS, seeds):
        tell(line)


def told(name: str, way: str, made: list[Chains], high: float) -> dict[str, Any]:
    """A row for one sampler on one drawing, whose long run lies at `high` nats, printed."""
    below = np.mean([high - np.quantile(one.log_density, (0.5, 0.05)) for one in made], axis=0)
    line = {
        "design": name,
        "sampler": way,
        "gradients": round(float(np.mean([one.gradients for one in made]))),
        "cpu": round(float(np.mean([one.cpu for one in made])), 3),
        "bins": round(float(np.mean([coverage.reached(one.all_draws).mean() for one in made])), 1),
        "effective": round(float(np.mean([one.effective for one in made])), 1),
        "least": round(float(np.mean([one.least for one in made])), 1),
        "below": [round(float(nats)) for nats in below],
    }
    print(
        f"{name:8} {way:22} {line['gradients']:9} {line['cpu']:8.2f} {line['bins']:6.1f} {line['effective']:10.1f}"
        f" {line['least']:7.1f}   {line['below'][0]}, {line['below'][1]}",
        flush=True,
    )
    return line


def ask(density: nw.LogDensity, x: np.ndarray) -> tuple[float, np.ndarray]:
    """Value and gradient; minus infinity where the model fails, which ends a trajectory."""
    try:
        return density.value_and_gradient(x)
    except ModelFault:
        return -np.inf, np.zeros_like(x)


def stack(draws: int, steps: int, seeds: tuple[int, ...]) -> list[dict[str, Any]]:
    """Six blocks on one another, both samplers from where `niwaki.stacks.start` finds a balance."""
    theirs, default = [], []
    for seed in seeds:
        density, x = stacks.start(stacks.stack, seed=seed, width=STACK_WIDTH)
        begun = time.process_time()
        found, _ = original.hmc(partial(ask, density), x, draws, steps, seed)
        theirs.append((found[None], draws * steps, time.process_time() - begun))
        begun = time.process_time()
        made = nw.run(
            stacks.stack,
            width=STACK_WIDTH,
            method=nw.nuts(chains=1, draws=draws, warmup=draws),
            choices=density.values(x),
            seed=seed,
            threads=1,
        )
        default.append((made.positions[0][None], made.gradients, time.process_time() - begun))
    rows = []
    for way, found in (("HMC as the original", theirs), ("nuts", default)):
        worth = [diagnostics.ess_vector(one) for one, _, _ in found]
        least = [min(diagnostics.ess_bulk(one[:, :, k]) for k in range(one.shape[2])) for one, _, _ in found]
        line = {
            "design": "stack",
            "sampler": way,
            "gradients": round(float(np.mean([count for _, count, _ in found]))),
            "cpu": round(float(np.mean([spent for _, _, spent in found])), 3),
            "effective": round(float(np.mean(worth)), 1),
            "least": round(float(np.mean(least)), 1),
        }
        print(
            f"{'stack':8} {way:22} {line['gradients']:9} {line['cpu']:8.2f} {'-':>6} {line['effective']:10.1f}"
            f" {line['least']:7.1f}",
            flush=True,
        )
        rows.append(line)
    return rows
