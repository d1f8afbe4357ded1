"""Draws from a distribution that is a value, and from values; how a word draws from a family."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ParamSpec, TypeVar

from niwaki.words import distributions as d
from niwaki.words.running import runner

__all__ = ["choose", "sample"]

P = ParamSpec("P")
T = TypeVar("T")


def draws(name: str, family: Callable[P, d.Distribution], drawn: type[T]) -> Callable[P, T]:
    """The word that draws from a family, and what type of value it gives."""

    def draw(*args: P.args, **kwargs: P.kwargs) -> T:
        value: T = runner(name).sample(family(*args, **kwargs))
        return value

    draw.__name__ = draw.__qualname__ = name
    draw.__doc__, draw.__wrapped__ = family.__doc__, family  # type: ignore[attr-defined]
    return draw


def sample(dist: d.Distribution) -> Any:
    """Draw a value from a distribution.

    Parameters
    ----------
    dist
        A distribution value such as `Gaussian(0, 1)`.
    """
    return runner("sample").sample(dist)


def choose(values: Sequence[T], weights: Sequence[float] | None = None) -> T:
    """One of `values`, all equally likely or with probability proportional to its weight.

    Parameters
    ----------
    values
        What to choose from, a list or tuple; not empty.
    weights
        Weight of each value, as many as values.
    """
    dist = d.DiscreteUniform(0, len(values) - 1) if weights is None else d.Categorical(weights)
    index: int = runner("choose").sample(dist)
    return values[index]
