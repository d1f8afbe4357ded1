"""The words `sample` and `choose`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

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


def choose(values: Sequence[T], weights: Sequence[float] | None = None, *, label: str | None = None) -> T:
    """Choose one of `values`, all equally likely or with probability proportional to weights.

    Parameters
    ----------
    values
        A list or tuple of values, not empty.
    weights
        The weight of each value; by default all are equal.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    dist = d.DiscreteUniform(0, len(values) - 1) if weights is None else d.Categorical(weights)
    index: int = runner("choose").sample(dist)
    return values[index]
