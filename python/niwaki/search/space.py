"""The parameters of a model that is fitted: their ranges, and the conditions under which they are used.

    {"width": nw.Uniform(20, 80), "holes": nw.DiscreteUniform(0, 6), "slot": nw.Bernoulli(),
     "finish": ["raw", "round"], "hole": Parameter(nw.Uniform(2, 8), when={"holes": range(1, 7)})}

The engine sees a row of numbers in the unit cube: the probability of a real number below it, and the middle of its
level for the others. A parameter that is not used stands at 0.5.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from math import exp, isfinite, log
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import InputError
from niwaki.errors.settings import shown
from niwaki.lang import densities
from niwaki.words.distributions import (
    Bernoulli,
    Categorical,
    DiscreteUniform,
    Distribution,
    Gaussian,
    LogNormal,
    Uniform,
)

#: Values of other parameters under which a parameter is used: a value or several for each name; all must hold.
When = Mapping[str, Any]

#: A level of a whole number, switch or choice is counted up to this number.
MOST_LEVELS = 4096

#: Draws that show the quantiles of a distribution that has no formula here.
DRAWS = 512

#: Probabilities at the ends of a range without bounds.
TAIL = 1e-6

EXPECTED = "a distribution such as `Uniform(lo, hi)` or `DiscreteUniform(lo, hi)`, `Bernoulli()`, or a list of values"


@dataclass(frozen=True)
class Parameter:
    """A parameter: its range, and when it is used.

    Parameters
    ----------
    range
        A distribution of real or whole numbers such as `Uniform`, `LogNormal` or `DiscreteUniform`, `Bernoulli` for a
        switch, `Categorical` for an index; a list or tuple of values for a choice.
    when
        The values of other parameters under which the parameter is used, such as `{"web": ["holes", "arms"]}`. All of
        them must hold. Of several mappings, one must hold. None: it is always used.
    """

    range: Distribution | Sequence[Any]
    when: When | Sequence[When] | None = None


@dataclass(frozen=True)
class Axis:
    """One parameter as a space reads it.

    Attributes
    ----------
    name : str
        Its name.
    kind : str
        "real", "whole" or "choice"; a switch is a choice of two values.
    values : sequence
        The values of its levels; empty for a real number.
    weights : tuple of float or None
        Probabilities of the levels; None if they are equal.
    range : Distribution or None
        The distribution of a real number.
    when : tuple
        Conditions, of which one must hold: pairs of a parameter's number and its levels, all of which must hold.
    """

    name: str
    kind: str
    values: Sequence[Any]
    weights: tuple[float, ...] | None
    range: Distribution | None
    when: tuple[tuple[tuple[int, tuple[int, ...]], ...], ...]

    def value(self, place: float) -> Any:
        """Return the value at a place of the unit interval."""
        if self.range is None:
            return self.values[min(int(place * len(self.values)), len(self.values) - 1)]
        inner = min(max(place, TAIL), 1.0 - TAIL)
        match self.range:
            case Uniform(lo, hi):
                return lo + min(max(place, 0.0), 1.0) * (hi - lo)
            case Gaussian(mean, sd):
                return mean + sd * NormalDist().inv_cdf(inner)
            case LogNormal(mean, sd):
                return exp(mean + sd * NormalDist().inv_cdf(inner))
        assert self.range is not None
        table = quantiles(self.range)
        return float(np.interp(place, np.linspace(0.0, 1.0, len(table)), table))

    def level(self, value: Any) -> int | None:
        """Return the level of a value, or None."""
        for number, other in enumerate(self.values):
            if type(other) is type(value) and other == value:
                return number
        # Whole numbers may come as floats, from a file.
        return next((k for k, other in enumerate(self.values) if other == value), None)

    def place(self, value: Any) -> float:
        """Return the place of a value in the unit interval."""
        if self.range is None:
            level = self.level(value)
            if level is None:
                raise wrong(self.name, value, f"one of {shown(list(self.values))}")
            return (level + 0.5) / len(self.values)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not isfinite(value):
            raise wrong(self.name, value, "a number")
        match self.range:
            case Uniform(lo, hi):
                place = (value - lo) / (hi - lo)
            case Gaussian(mean, sd):
                place = NormalDist(mean, sd).cdf(value)
            case LogNormal(mean, sd):
                place = NormalDist(mean, sd).cdf(log(value)) if value > 0 else 0.0
            case _:
                table = quantiles(self.range)
                place = float(np.interp(value, table, np.linspace(0.0, 1.0, len(table))))
        if not -1e-9 <= place <= 1.0 + 1e-9:
            raise wrong(self.name, value, f"a value of {self.range}")
        return min(max(place, 0.0), 1.0)


class Space:
    """The parameters of a model by name, in the order in which they are drawn.

    Parameters
    ----------
    parameters
        A range or a `Parameter` for each name. A condition may name only parameters before its own that have levels.

    Attributes
    ----------
    axes : tuple of Axis
    """

    def __init__(self, parameters: Mapping[str, Parameter | Distribution | Sequence[Any]]) -> None:
        if not parameters:
            raise wrong("parameters", {}, "at least one parameter")
        self.axes: tuple[Axis, ...] = ()
        for name, range in parameters.items():
            self.axes += (self._axis(str(name), range),)

    @classmethod
    def of(cls, parameters: Space | Mapping[str, Any]) -> Space:
        """Return a space, or make it from parameters by name."""
        return parameters if isinstance(parameters, Space) else cls(parameters)

    @property
    def names(self) -> list[str]:
        """The names of all parameters."""
        return [axis.name for axis in self.axes]

    def axis(self, name: str) -> Axis:
        """Return a parameter by name."""
        for axis in self.axes:
            if axis.name == name:
                return axis
        raise wrong("parameter", name, f"one of {', '.join(self.names)}")

    def values(self, row: Sequence[float], used: Sequence[bool]) -> dict[str, Any]:
        """Return the values of the parameters that are used, by name."""
        return {axis.name: axis.value(x) for axis, x, on in zip(self.axes, row, used, strict=True) if on}

    def row(self, values: Mapping[str, Any]) -> tuple[list[float], list[bool]]:
        """Return the row of some values, and which parameters they use.

        Every parameter that is used must have a value. Values of unused parameters are ignored.
        """
        for name in values:
            self.axis(name)
        row, used = [0.5] * len(self.axes), [False] * len(self.axes)
        levels: list[int | None] = []
        for k, axis in enumerate(self.axes):
            on = not axis.when or any(
                all(levels[other] in allowed for other, allowed in rule) for rule in axis.when
            )
            if on and axis.name not in values:
                raise wrong(axis.name, "nothing", "a value, because the parameter is used")
            if on:
                row[k], used[k] = axis.place(values[axis.name]), True
            levels.append(axis.level(values[axis.name]) if on and axis.range is None else None)
        return row, used

    def data(self) -> list[dict[str, Any]]:
        """Return the space as plain data: what the engine reads, and what a stored search is compared by."""
        return [
            {
                "name": axis.name,
                "kind": axis.kind,
                "levels": len(axis.values),
                "weights": axis.weights,
                "when": axis.when,
                "range": repr(axis.range)
                if axis.range is not None
                else [shown(value) for value in axis.values],
            }
            for axis in self.axes
        ]

    def _axis(self, name: str, value: Any) -> Axis:
        parameter = value if isinstance(value, Parameter) else Parameter(value)
        when = self._when(name, parameter.when)
        weights: tuple[float, ...] | None = None
        match parameter.range:
            case Uniform(lo, hi) as real:
                if not (isfinite(lo) and isfinite(hi) and lo < hi):
                    raise wrong(name, real, "two finite ends, the lower one first")
                return Axis(name, "real", (), None, Uniform(float(lo), float(hi)), when)
            case Gaussian(mean, sd) | LogNormal(mean, sd) as real:
                if not (isfinite(mean) and isfinite(sd) and sd > 0):
                    raise wrong(name, real, "a finite mean and a standard deviation above 0")
                return Axis(name, "real", (), None, real, when)
            case DiscreteUniform(lo, hi) as whole:
                if int(lo) != lo or int(hi) != hi or lo > hi or hi - lo >= MOST_LEVELS:
                    raise wrong(
                        name, whole, f"two whole numbers, the lower one first, at most {MOST_LEVELS} values"
                    )
                return Axis(name, "whole", range(int(lo), int(hi) + 1), None, None, when)
            case Bernoulli(p) as switch:
                if not 0 <= p <= 1:
                    raise wrong(name, switch, "a probability from 0 to 1")
                return Axis(name, "choice", (False, True), None if p == 0.5 else (1.0 - p, p), None, when)
            case Categorical(given_weights) as index:
                weights = tuple(float(weight) for weight in given_weights)
                if not weights or min(weights) < 0 or not 0 < sum(weights) < float("inf"):
                    raise wrong(name, index, "weights, not negative and not all zero")
                return Axis(name, "choice", range(len(weights)), weights, None, when)
            case Distribution() as counts if isinstance(_draws(counts)[0], int):
                table = _draws(counts)
                levels = range(int(table[0]), int(table[-1]) + 1)[:MOST_LEVELS]
                weights = tuple(exp(densities.log_density(counts, level)) for level in levels)
                return Axis(name, "whole", levels, weights, None, when)
            case Distribution() as real if isinstance(_draws(real)[0], float):
                return Axis(name, "real", (), None, real, when)
            case list() | tuple() | range() as values if 0 < len(values) <= MOST_LEVELS:
                return Axis(name, "choice", tuple(values), None, None, when)
        raise wrong(name, parameter.range, EXPECTED)

    def _when(self, name: str, when: Any) -> tuple[tuple[tuple[int, tuple[int, ...]], ...], ...]:
        if when is None:
            return ()
        rules = [when] if isinstance(when, Mapping) else list(when)
        before = {axis.name: number for number, axis in enumerate(self.axes)}
        out = []
        for rule in rules:
            terms = []
            for other, allowed in rule.items():
                if other not in before:
                    raise wrong(
                        name, when, f"conditions on parameters before it: {', '.join(before) or 'none'}"
                    )
                axis = self.axes[before[other]]
                if axis.range is not None:
                    raise wrong(
                        name, when, f"conditions on whole numbers, switches and choices; `{other}` is real"
                    )
                listed = list(allowed) if _is_several(allowed) else [allowed]
                levels = [axis.level(value) for value in listed]
                if None in levels or not levels:
                    raise wrong(name, when, f"values of `{other}`: {shown(list(axis.values))}")
                terms.append((before[other], tuple(sorted({level for level in levels if level is not None}))))
            out.append(tuple(terms))
        return tuple(out)


@cache
def _draws(dist: Distribution) -> list[Any]:
    """Draws of a distribution in their order; one that is no number or a bad parameter stands alone."""
    try:
        draws = [densities.draw(dist, 0, str(number)) for number in range(DRAWS)]
    except (ValueError, TypeError):
        return [None]
    kinds = {type(draw) for draw in draws}
    return sorted(draws) if kinds <= {int} or kinds <= {float} else [None]


@cache
def quantiles(dist: Distribution) -> NDArray[np.float64]:
    """Quantiles of a distribution of real numbers, by the order of its draws."""
    return np.array(_draws(dist), float)


def wrong(name: str, value: Any, expected: str) -> InputError:
    """Return the error about a parameter's range or value."""
    return InputError(
        "bad-setting",
        name=name,
        found=shown(value),
        expected=expected,
        suggestion="`Uniform(20, 80)`, for instance" if expected == EXPECTED else "such a value",
    )


def _is_several(allowed: Any) -> bool:
    return isinstance(allowed, Iterable) and not isinstance(allowed, (str, bytes))
