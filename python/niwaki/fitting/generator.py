"""The interface of a generator.

A point crosses to a worker process as plain numbers: reals and whole numbers as they are, the values of switches and
choices by their index. So a choice may have values of any type.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from niwaki.fitting.draws import Drawn
from niwaki.search.space import Space

#: The point of a generator as plain numbers, by name.
Numbers = Mapping[str, float]


@dataclass(frozen=True)
class Called:
    """The outcome of one call.

    Attributes
    ----------
    mesh : object
        What the generator returned: see `niwaki.fitting.meshes`.
    drawn : list of Drawn
        The draws of a function that is defined by run, in order; empty for all others.
    parts : dict or None
        What was returned as parts with names, in place of one mesh.
    facts : list
        What the generator says about the result, as JSON.
    """

    mesh: Any
    drawn: list[Drawn] = field(default_factory=list)
    parts: Mapping[str, Any] | None = None
    facts: list[Any] = field(default_factory=list)


class Generator(ABC):
    """A model of which only parameters and a mesh are known.

    Attributes
    ----------
    name : str
        Its name in messages, tables and pictures.
    space : Space or None
        Its parameters; None if only a run shows them.
    """

    name: str
    space: Space | None

    @abstractmethod
    def call(self, numbers: Numbers) -> Called:
        """Call the generator with a point as plain numbers."""

    @abstractmethod
    def identity(self) -> dict[str, str]:
        """Return what decides its meshes, by name: hashes of files, the words of a command."""

    @abstractmethod
    def recipe(self) -> dict[str, Any] | None:
        """Return the data from which a worker process makes it again; None if it must stay in this process."""

    def worker_command(self) -> list[str] | None:
        """Return the words that start a worker process of another program; None for Niwaki's own (`worker.serve`).

        The program reads the recipe and points, and answers, as Niwaki's worker does.
        """
        return None

    @property
    def reason(self) -> str:
        """The reason why it must stay in this process."""
        return ""

    def values(self, numbers: Numbers) -> dict[str, Any]:
        """Return the values of plain numbers by name, as the generator gets them."""
        assert self.space is not None
        return {name: value_of(self.space, name, number) for name, number in numbers.items()}


def value_of(space: Space, name: str, number: float) -> Any:
    """Return the value of a plain number."""
    axis = space.axis(name)
    return (
        axis.values[int(number)] if axis.kind == "choice" else int(number) if axis.kind == "whole" else number
    )


def number_of(space: Space, name: str, value: Any) -> float:
    """Return the plain number of a value."""
    axis = space.axis(name)
    if axis.kind != "choice":
        return int(value) if axis.kind == "whole" else float(value)
    level = axis.level(value)
    assert level is not None
    return level
