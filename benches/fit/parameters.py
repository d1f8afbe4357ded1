"""Parameters of a generator: names, kinds, ranges, and the conditions under which they are used."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

Values = dict[str, Any]


@dataclass(frozen=True)
class Parameter:
    """A parameter.

    Attributes
    ----------
    kind : str
        "real", "whole", "switch" or "choice".
    domain : tuple
        Low and high end of a number, both included; the values of a switch or a choice.
    when : function or None
        Tells from the parameters before it whether it is used.
    """

    name: str
    kind: str
    domain: tuple[Any, ...]
    when: Callable[[Values], Any] | None = None

    def used(self, values: Values) -> bool:
        return self.when is None or bool(self.when(values))

    @property
    def unused(self) -> Any:
        """The value that the geometry sees where it is not used."""
        return False if self.kind == "switch" else None

    @property
    def levels(self) -> tuple[Any, ...]:
        """All values of a parameter that is not real."""
        return tuple(range(self.domain[0], self.domain[1] + 1)) if self.kind == "whole" else self.domain

    def draw(self, random: np.random.Generator) -> Any:
        if self.kind == "real":
            return random.uniform(*self.domain)
        if self.kind == "whole":
            return int(random.integers(self.domain[0], self.domain[1] + 1))
        if self.kind == "switch":
            return bool(random.integers(2))
        return self.domain[random.integers(len(self.domain))]


def real(name: str, low: float, high: float, when: Callable[[Values], Any] | None = None) -> Parameter:
    return Parameter(name, "real", (low, high), when)


def whole(name: str, low: int, high: int, when: Callable[[Values], Any] | None = None) -> Parameter:
    return Parameter(name, "whole", (low, high), when)


def switch(name: str, when: Callable[[Values], Any] | None = None) -> Parameter:
    return Parameter(name, "switch", (False, True), when)


def choice(name: str, *values: str, when: Callable[[Values], Any] | None = None) -> Parameter:
    return Parameter(name, "choice", values, when)


def drawn(parameters: Sequence[Parameter], random: np.random.Generator) -> Values:
    """Draw all parameters in order; those that are not used are skipped."""
    values: Values = {}
    for parameter in parameters:
        values[parameter.name] = parameter.draw(random) if parameter.used(values) else parameter.unused
    return values


def canonical(parameters: Sequence[Parameter], raw: Mapping[str, Any]) -> tuple[tuple[str, ...], Values]:
    """Return the names of the parameters that are used, and all values, with those that are not used replaced."""
    names, values = [], {}
    for parameter in parameters:
        if parameter.used(values):
            names.append(parameter.name)
            values[parameter.name] = raw[parameter.name]
        else:
            values[parameter.name] = parameter.unused
    return tuple(names), values
