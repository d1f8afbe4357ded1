"""The synthetic data of the statistical programs (dissertation, appendix A), made by code with fixed seeds.

The data of a smaller size are the first part of the data of a larger size. The generator is small and written out
(mulberry32, 32 bits), so that any other program can make the same numbers without a library.
A size of 1 has 100 observations, a size of 10 has a thousand.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

MASK = 0xFFFFFFFF

Row = tuple[float, ...]


class Chain(NamedTuple):
    """A hidden Markov chain: probabilities (S,), (S, S), (S, O), the hidden states, and the observations."""

    initial: Row
    transition: tuple[Row, ...]
    emission: tuple[Row, ...]
    states: tuple[int, ...]
    observations: tuple[int, ...]


def generator(seed: int) -> Callable[[], float]:
    """Return a function that draws uniform numbers in [0, 1), the same on every machine."""
    state = seed

    def uniform() -> float:
        nonlocal state
        state = (state + 0x6D2B79F5) & MASK
        mixed = (state ^ (state >> 15)) * (state | 1) & MASK
        mixed ^= (mixed + ((mixed ^ (mixed >> 7)) * (mixed | 61) & MASK)) & MASK
        return (mixed ^ (mixed >> 14)) / 2**32

    return uniform


def hidden_chain(steps: int = 100, states: int = 10, symbols: int = 10, seed: int = 11) -> Chain:
    """Draw a chain with uniform tables, and its observations in `steps` steps."""
    uniform = generator(seed)
    initial = _simplex(uniform, states)
    transition = tuple(_simplex(uniform, states) for _ in range(states))
    emission = tuple(_simplex(uniform, symbols) for _ in range(states))
    hidden: list[int] = []
    seen: list[int] = []
    for _ in range(steps):
        hidden.append(_pick(uniform, transition[hidden[-1]] if hidden else initial))
        seen.append(_pick(uniform, emission[hidden[-1]]))
    return Chain(initial, transition, emission, tuple(hidden), tuple(seen))


def documents(
    count: int = 5, topics: int = 10, vocabulary: int = 100, words: int = 20, seed: int = 12
) -> tuple[tuple[int, ...], ...]:
    """Draw documents, (count, words) of whole numbers; each word is from a topic of its document."""
    uniform = generator(seed)
    spoken = [_simplex(uniform, vocabulary) for _ in range(topics)]
    values: list[tuple[int, ...]] = []
    for _ in range(count):
        share = _simplex(uniform, topics)
        values.append(tuple(_pick(uniform, spoken[_pick(uniform, share)]) for _ in range(words)))
    return tuple(values)


def clusters(points: int = 100, seed: int = 13) -> Row:
    """Draw numbers from a mixture of four Gaussians."""
    uniform = generator(seed)
    means, deviations, weights = (-6.0, -1.0, 2.0, 7.0), (1.0, 0.6, 0.8, 1.2), (0.2, 0.3, 0.3, 0.2)
    values: list[float] = []
    for _ in range(points):
        cluster = _pick(uniform, weights)
        values.append(means[cluster] + deviations[cluster] * _normal(uniform))
    return tuple(values)


def growth(sequences: int = 20, seed: int = 14) -> tuple[Row, ...]:
    """Draw sequences measured at -2, -1, 0, 1, 2, each along a line: (sequences, 5)."""
    uniform = generator(seed)
    values: list[Row] = []
    for _ in range(sequences):
        start, slope = 1.0 + 0.8 * _normal(uniform), 0.5 + 0.4 * _normal(uniform)
        values.append(tuple(start + slope * x + 0.5 * _normal(uniform) for x in (-2.0, -1.0, 0.0, 1.0, 2.0)))
    return tuple(values)


def _simplex(uniform: Callable[[], float], size: int) -> Row:
    """Draw probabilities uniformly."""
    draws = [-math.log(1.0 - uniform()) for _ in range(size)]
    total = 0.0
    for draw in draws:
        total += draw
    return tuple(draw / total for draw in draws)


def _pick(uniform: Callable[[], float], probabilities: Row) -> int:
    """Draw an index by probabilities."""
    point, total = uniform(), 0.0
    for index, probability in enumerate(probabilities):
        total += probability
        if point < total:
            return index
    return len(probabilities) - 1


def _normal(uniform: Callable[[], float]) -> float:
    """Draw a standard normal number (Box & Muller)."""
    radius = math.sqrt(-2.0 * math.log(1.0 - uniform()))
    return radius * math.cos(2.0 * math.pi * uniform())
