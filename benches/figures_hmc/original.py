"""The samplers of dissertation chapter 4 as in its own code, over one of our log densities.

HMC: no metric, a fixed number of leapfrog steps, a first step found from the log density alone, and dual averaging
that never stops, with half the usual gain and its iterates drawn to a step of about 1. MH: one coordinate at a time,
moved by a normal of its own width in the bounded space, while the density is that of the unbounded one;
each width grows or shrinks by 1 % at each proposal, without end.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Gradient = Callable[[Reals], tuple[float, Reals]]
ACCEPTED, MH_ACCEPTED = 0.65, 0.234
CLOSEST = 1e-15


def hmc(density: Gradient, x: Reals, draws: int, steps: int, seed: int) -> tuple[Reals, float]:
    """Draws in the coordinates of `density`, (draws, dim), and the share of moves accepted."""
    random = np.random.default_rng(seed)
    value, slope = density(x)
    step = first_step(density, x, random)
    drawn_to, error, accepted, states = step, 0.0, 0, np.empty((draws, len(x)))
    for k in range(1, draws + 1):
        momentum = random.normal(size=len(x))
        energy = value - 0.5 * momentum @ momentum
        there, at, turn = x, value, slope
        momentum = momentum + 0.5 * step * turn
        for left in range(steps - 1, -1, -1):
            there = there + step * momentum
            at, turn = density(there)
            if not math.isfinite(at):
                break
            momentum = momentum + (step if left else 0.5 * step) * turn
        change = at - 0.5 * momentum @ momentum - energy
        chance = math.exp(min(0.0, change)) if math.isfinite(change) else 0.0
        if random.uniform() < chance:
            x, value, slope, accepted = there, at, turn, accepted + 1
        states[k - 1] = x
        error += (ACCEPTED - chance - error) / (k + 10)
        step = math.exp(drawn_to - 0.5 * math.sqrt(k) / 0.05 * error)
    return states, accepted / draws


def first_step(density: Gradient, x: Reals, random: np.random.Generator) -> float:
    """From 1, doubled or halved until the log density after one step crosses half of what it was."""
    value, slope = density(x)
    step, direction = 1.0, 0
    for _ in range(100):
        momentum = random.normal(size=len(x)) + 0.5 * step * slope
        rises = density(x + step * momentum)[0] - value > math.log(0.5)
        direction = direction or (1 if rises else -1)
        if rises != (direction > 0):
            break
        step *= 2.0**direction
    return step


def mh(
    density: Gradient,
    x: Reals,
    iterations: int,
    seed: int,
    bounds: tuple[float, float],
    width: float = 1.0,
    thin: int = 1,
    adapts: bool = True,
    corrected: bool = False,
) -> tuple[Reals, float]:
    """Draws in the coordinates of `density`, every `thin`-th, and the share of proposals accepted.

    Every coordinate is that of a number within the same bounds; a move across them ends at them. `corrected` asks the
    density of the bounded numbers, and refuses such moves.
    """
    random = np.random.default_rng(seed)
    low, high = bounds
    inside = (high - low) * CLOSEST
    y = low + (high - low) / (1.0 + np.exp(-x))
    value = density(x)[0]
    widths, proposed, accepted_counts = np.full(len(x), width), np.zeros(len(x)), np.zeros(len(x))
    states = np.empty((iterations // thin, len(x)))
    for k in range(iterations):
        i = int(random.integers(len(x)))
        candidate = y[i] + widths[i] * random.normal()
        moved = min(max(candidate, low + inside), high - inside)
        there = x.copy()
        there[i] = math.log(moved - low) - math.log(high - moved)
        at = density(there)[0]
        proposed[i] += 1
        log_ratio = at - value
        if corrected:
            # The Jacobian of a bounded number is (y - low) (high - y), up to a factor. What would be moved back to the
            # bounds is refused: the reverse move is a different one.
            log_ratio += math.log((y[i] - low) * (high - y[i]) / ((moved - low) * (high - moved)))
            log_ratio = log_ratio if moved == candidate else -math.inf
        if math.log(1.0 - random.uniform()) < log_ratio:
            x, value = there, at
            y[i] = moved
            accepted_counts[i] += 1
        if adapts:
            widths[i] *= 1.01 if accepted_counts[i] / proposed[i] > MH_ACCEPTED else 1.0 / 1.01
        if (k + 1) % thin == 0:
            states[(k + 1) // thin - 1] = x
    return states, float(accepted_counts.sum() / iterations)
