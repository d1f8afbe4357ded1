"""The data of the bench programs: made here once, read by all three systems.

A hidden Markov chain of 10 states, 10 symbols and 100 steps, drawn from flat Dirichlet rows with a small
generator of 32 bits (mulberry32), so that the numbers do not depend on any library's version.
"""

import json
import math
from collections.abc import Callable
from pathlib import Path

MASK = 0xFFFFFFFF


def generator(seed: int) -> Callable[[], float]:
    """Uniform numbers in [0, 1), the same on every machine."""
    state = seed

    def uniform() -> float:
        nonlocal state
        state = (state + 0x6D2B79F5) & MASK
        mixed = (state ^ (state >> 15)) * (state | 1) & MASK
        mixed ^= (mixed + ((mixed ^ (mixed >> 7)) * (mixed | 61) & MASK)) & MASK
        return (mixed ^ (mixed >> 14)) / 2**32

    return uniform


def flat_dirichlet(uniform: Callable[[], float], size: int) -> list[float]:
    """Probabilities drawn uniformly from the simplex."""
    draws = [-math.log(1 - uniform()) for _ in range(size)]
    return [draw / sum(draws) for draw in draws]


def pick(uniform: Callable[[], float], probabilities: list[float]) -> int:
    """An index drawn from its probabilities."""
    point, total = uniform(), 0.0
    for index, probability in enumerate(probabilities):
        total += probability
        if point < total:
            return index
    return len(probabilities) - 1


def hmm(steps: int = 100, states: int = 10, symbols: int = 10, seed: int = 11) -> dict[str, list]:
    """Tables and what was seen: initial (S,), transition (S, S), emission (S, O), observations (N,)."""
    uniform = generator(seed)
    initial = flat_dirichlet(uniform, states)
    transition = [flat_dirichlet(uniform, states) for _ in range(states)]
    emission = [flat_dirichlet(uniform, symbols) for _ in range(states)]
    state, observations = pick(uniform, initial), []
    for n in range(steps):
        if n > 0:
            state = pick(uniform, transition[state])
        observations.append(pick(uniform, emission[state]))
    return {"initial": initial, "transition": transition, "emission": emission, "observations": observations}


def write(folder: Path) -> Path:
    """Write the chain as JSON into `folder` and return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "hmm.json"
    path.write_text(json.dumps(hmm()))
    return path
