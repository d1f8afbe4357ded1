"""The words `sample` and `choose`, and the maker of words that draw from a family."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar, overload

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


@overload
def choose(values: Mapping[T, float]) -> T: ...
@overload
def choose(values: Sequence[T], weights: Sequence[float] | None = None) -> T: ...
def choose(values: Any, weights: Any = None) -> Any:
    """Choose one of `values`, all equally likely or with probability proportional to weights.

    Where the values are distinct strings, the choice is recorded as one of these words; else as the place of the value.

    Parameters
    ----------
    values
        A list or tuple of values, not empty; or a dict of values with their weights, written at the call or a constant
        of the module.
    weights
        The weight of each value; by default all are equal.
    """
    if isinstance(values, Mapping):
        if weights is not None:
            raise TypeError("`choose` got weights twice: in the dict, and in `weights`")
        values, weights = list(values), list(values.values())
    dist = d.DiscreteUniform(0, len(values) - 1) if weights is None else d.Categorical(weights)
    return values[runner("choose").sample(dist, words_of(values))]


def words_of(values: Any) -> Sequence[str] | None:
    """Return the options of a choice if these are distinct strings, which name their places; else None."""
    if not isinstance(values, list | tuple) or not values or not all(isinstance(x, str) for x in values):
        return None
    return values if len(set(values)) == len(values) else None
