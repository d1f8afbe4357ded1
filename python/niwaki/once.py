"""Attributes that are computed at the first reading, and then stored."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, Self, TypeVar, overload

R = TypeVar("R")


class cached_property(Generic[R]):
    """A property that is computed at the first reading, and then stored as an attribute of the object.

    On Python 3.11, `functools.cached_property` has a lock for all objects of a class, and holds it while it computes:
    threads wait for one another, and a process that is forked meanwhile waits forever. This property has no lock. If
    two threads read it at the same time, both compute the value, and one value is stored.

    Parameters
    ----------
    compute
        The method that computes the value.
    """

    def __init__(self, compute: Callable[[Any], R]) -> None:
        self._compute, self._name, self.__doc__ = compute, compute.__name__, compute.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        """Store the property's name in the class."""
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...

    @overload
    def __get__(self, instance: object, owner: type) -> R: ...

    def __get__(self, instance: object | None, owner: type) -> Self | R:
        """Return the value; later, Python reads the object's attribute instead."""
        if instance is None:
            return self
        value: R = instance.__dict__.setdefault(self._name, self._compute(instance))
        return value
