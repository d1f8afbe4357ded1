"""The words `sample` and `choose`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeVar, overload

from niwaki.words import distributions as d
from niwaki.words.running import runner

__all__ = ["choose", "sample"]

T = TypeVar("T")


def sample(dist: d.Distribution, *, label: str | None = None) -> Any:
    """Draw a value from a distribution.

    Parameters
    ----------
    dist
        A distribution value such as `Gaussian(0, 1)`.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    return runner("sample").sample(dist)


@overload
def choose(values: Mapping[T, float], *, label: str | None = None) -> T: ...
@overload
def choose(values: Sequence[T], weights: Sequence[float] | None = None, *, label: str | None = None) -> T: ...
def choose(values: Any, weights: Any = None, *, label: str | None = None) -> Any:
    """Choose one of `values`, all equally likely or with probability proportional to weights.

    Where the values are distinct strings, the choice is recorded as one of these words; else as the place of the value.

    Parameters
    ----------
    values
        A list or tuple of values, not empty; or a dict of values with their weights, written at the call or a constant
        of the module.
    weights
        The weight of each value; by default all are equal.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    if isinstance(values, Mapping):
        if weights is not None:
            raise TypeError("`choose` got weights twice: in the dict, and in `weights`")
        values, weights = list(values), list(values.values())
    if isinstance(weights, str | float | int):
        raise TypeError(f"`choose` takes its options as one list: `choose([{values!r}, {weights!r}])`")
    dist = d.DiscreteUniform(0, len(values) - 1) if weights is None else d.Categorical(weights)
    return values[runner("choose").sample(dist, words_of(values))]


def words_of(values: Any) -> Sequence[str] | None:
    """Return the options of a choice if these are distinct strings, which name their places; else None."""
    if not isinstance(values, list | tuple) or not values or not all(isinstance(x, str) for x in values):
        return None
    return values if len(set(values)) == len(values) else None
