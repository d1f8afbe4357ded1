"""The words `sample` and `choose`, and the maker of words that draw from a family."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ParamSpec, TypeVar

from niwaki.words import distributions as d
from niwaki.words.running import runner

__all__ = ["choose", "sample"]

P = ParamSpec("P")
T = TypeVar("T")


def draws(name: str, family: Callable[P, d.Distribution], drawn: type[T]) -> Callable[P, T]:
    """Make the word that draws from a family; `drawn` is the type of its values."""

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
    """Choose one of `values`, all equally likely or with probability proportional to weights.

    Parameters
    ----------
    values
        A list or tuple of values, not empty.
    weights
        The weight of each value; by default all are equal.
    """
    dist = d.DiscreteUniform(0, len(values) - 1) if weights is None else d.Categorical(weights)
    index: int = runner("choose").sample(dist)
    return values[index]
