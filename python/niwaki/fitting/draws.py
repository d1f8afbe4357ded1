"""Draws while a function runs: its parameters, their ranges, and which of them it uses, are what it asks for.

def bracket(d):
    holes = d.whole("holes", 0, 4)
    diameter = d.real("diameter", 2, 8) if holes else None
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any


class DrawError(ValueError):
    """A function draws in a way that no search can follow."""


@dataclass(frozen=True)
class Drawn:
    """One draw of a run.

    Attributes
    ----------
    name : str
        Its name.
    kind : str
        "real", "whole" or "choice".
    low, high : float
        The range of a number; 0 and the last index of a choice.
    labels : tuple of str
        The values of a choice, as they are shown.
    number : float
        The plain number that was drawn.
    """

    name: str
    kind: str
    low: float
    high: float
    labels: tuple[str, ...]
    number: float

    @property
    def domain(self) -> tuple[Any, ...]:
        """Everything but the number."""
        return (self.kind, self.low, self.high, self.labels)


class Draws:
    """The draws of one run.

    Parameters
    ----------
    numbers
        Plain numbers by name. A draw without a number is decided by a hash of its name and of all numbers, so that the
        same point gives the same mesh.
    """

    def __init__(self, numbers: Mapping[str, float]) -> None:
        self.drawn: list[Drawn] = []
        self._numbers = numbers
        text = ";".join(f"{name}={number!r}" for name, number in sorted(numbers.items()))
        self._salt = hashlib.sha256(text.encode()).digest()

    def real(self, name: str, low: float, high: float) -> float:
        """Draw a real number from `low` to `high`."""
        if not (isfinite(low) and isfinite(high) and low < high):
            raise DrawError(
                f"the range of `{name}` is {low!r} to {high!r}: write two finite ends, the lower one first"
            )
        return self._draw(name, "real", float(low), float(high), ())

    def whole(self, name: str, low: int, high: int) -> int:
        """Draw a whole number from `low` to `high`, both included."""
        if int(low) != low or int(high) != high or low > high:
            raise DrawError(
                f"the range of `{name}` is {low!r} to {high!r}: write two whole numbers, the lower one first"
            )
        return int(self._draw(name, "whole", int(low), int(high), ()))

    def switch(self, name: str) -> bool:
        """Draw True or False."""
        return bool(self._draw(name, "choice", 0, 1, ("False", "True")))

    def choice(self, name: str, values: Sequence[Any]) -> Any:
        """Draw one of some values."""
        if not len(values):
            raise DrawError(f"`{name}` has no values to choose from: write at least one")
        labels = tuple(value if isinstance(value, str) else repr(value) for value in values)
        return values[int(self._draw(name, "choice", 0, len(values) - 1, labels))]

    def _draw(self, name: str, kind: str, low: float, high: float, labels: tuple[str, ...]) -> float:
        if any(earlier.name == name for earlier in self.drawn):
            raise DrawError(
                f"`{name}` is drawn twice in one run: give each draw a name of its own, such as `{name}2`"
            )
        number = self._numbers.get(name)
        if number is None:
            share = int.from_bytes(hashlib.sha256(self._salt + name.encode()).digest()[:6], "big") / 2**48
            number = low + share * (high - low) if kind == "real" else low + int(share * (high - low + 1))
        elif not low <= number <= high:
            raise DrawError(
                f"the range of `{name}` changes from run to run, and {number:g} is outside of {low:g} to {high:g}: "
                "draw a share between 0 and 1, and compute the value from it"
            )
        self.drawn.append(Drawn(name, kind, low, high, labels, number))
        return number
