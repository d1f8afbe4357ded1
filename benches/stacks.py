"""Structures of blocks: draws of each kind, the share that balances and the share that stands; none is left out.

    python benches/stacks.py [--draws 200] [--judge 200] [--stand 200] [--out out/stacks] [model ...]

Each chain starts where `niwaki.stacks.starting` finds a balance, warms up, and is judged by the linear program and by
MuJoCo. The sampler is one argument of `measure`; `plain_hmc` is the textbook's, with jittered length, a diagonal
metric and dual averaging, all frozen after warm-up.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import stacks
from niwaki.stacks import judges
from niwaki.stacks.starting import start
from niwaki.stacks.structure import Structure

WIDTHS = {
    "stack": 0.005,
    "lean": 0.005,
    "top_heavy": 0.005,
    "every_step": 0.005,
    "tilt_stack": 0.002,
    "tilt_arch": 0.002,
}
MODELS = (
    "stack lean top_heavy every_step platforms arch symmetric_arch tri_arch symmetric_tri_arch wheel "
    "cut_stack cut_lean cut_top_heavy cut_arch tilt_stack tilt_arch"
).split()
Sampler = Callable[[Any, Any, int, int, int], tuple[Any, float]]


def plain_hmc(
    density: Any, x: Any, draws: int, warmup: int, seed: int, steps: int = 200
) -> tuple[Any, float]:
    """Draws of shape (draws, dim) and the mean acceptance."""
    random = np.random.default_rng(seed)
    scale, epsilon, anchor, mean_error, log_mean, k = np.ones(density.dim), 1e-3, np.log(1e-2), 0.0, 0.0, 0
    value, slope = density.value_and_gradient(x)
    window: list[Any] = []
    wide, refresh = 75, 75
    kept, accepted = [], []
    for number in range(warmup + draws):
        p = random.normal(size=density.dim) / np.sqrt(scale)
        energy = value - 0.5 * np.sum(scale * p * p)
        q, there, at = x, slope, value
        alive = True
        for _ in range(max(1, int(steps * random.uniform(0.6, 1.4)))):
            p = p + 0.5 * epsilon * there
            q = q + epsilon * scale * p
            at, there = density.value_and_gradient(q)
            if not at - 0.5 * np.sum(scale * p * p) - energy > -1000.0:
                alive = False
                break
            p = p + 0.5 * epsilon * there
        chance = float(np.exp(min(0.0, at - 0.5 * np.sum(scale * p * p) - energy))) if alive else 0.0
        if random.uniform() < chance:
            x, value, slope = q, at, there
        if number >= warmup:
            kept.append(x)
            accepted.append(chance)
            continue
        k += 1
        mean_error += (0.8 - chance - mean_error) / (k + 10)
        log_epsilon = anchor - np.sqrt(k) / 0.05 * mean_error
        log_mean += k**-0.75 * (log_epsilon - log_mean)
        epsilon = np.exp(log_mean if number == warmup - 1 else log_epsilon)
        if number >= 50:
            window.append(x)
        if number == refresh and number < warmup - 40:
            count = len(window)
            scale = np.var(window, axis=0) * count / (count + 5) + 5e-3 / (count + 5)
            window, wide = [], 2 * wide
            refresh = number + wide
            epsilon = 0.3 * np.exp(log_mean)
            anchor, mean_error, log_mean, k = np.log(10 * epsilon), 0.0, 0.0, 0
    return np.array(kept), float(np.mean(accepted))


def measure(name: str, draws: int, judge: int, stand: int, sampler: Sampler, out: Path, seed: int = 4) -> str:
    """One row of the table."""
    model = getattr(stacks, name)
    width = WIDTHS.get(name, 0.01)
    begun = time.process_time()
    density, x = start(model, seed, width)
    found, acceptance = sampler(density, x, draws, 1000, seed)
    spent = time.process_time() - begun
    balances, stands, moved = 0, 0, []
    judged = np.unique(np.linspace(0, draws - 1, judge).astype(int))
    dropped = set(np.unique(np.linspace(0, judge - 1, stand).astype(int)))
    for place, number in enumerate(judged):
        sample = nw.run(model, width=width, choices=density.values(found[number])).best
        try:
            structure = Structure.of(sample)
        except nw.NiwakiError:
            moved += [np.inf] if place in dropped else []
            continue
        balances += judges.balanced(structure).holds
        if place in dropped:
            moved.append(judges.simulated(structure).moved)
            stands += moved[-1] <= 0.05
            sample.scene.save(out / f"{name}-{number}.png", size=(480, 480), azimuth=32, elevation=14)
    return (
        f"{name:20s} {density.dim:4d} {width:6.3f} {acceptance:5.2f} {spent:7.1f} "
        f"{balances:4d}/{len(judged)} {stands:4d}/{len(moved)} {max(moved):8.4f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("models", nargs="*", default=MODELS)
    parser.add_argument("--draws", type=int, default=200)
    parser.add_argument("--judge", type=int, default=200)
    parser.add_argument("--stand", type=int, default=200)
    parser.add_argument("--out", type=Path, default=Path("out/stacks"))
    asked = parser.parse_args()
    asked.out.mkdir(parents=True, exist_ok=True)
    print("model                dims  width  acc   cpu s  balance  stand  farthest", flush=True)
    for name in asked.models or MODELS:
        print(measure(name, asked.draws, asked.judge, asked.stand, plain_hmc, asked.out), flush=True)


if __name__ == "__main__":
    main()
