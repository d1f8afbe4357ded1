"""Attributes that are computed when they are first read, and kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, Self, TypeVar, overload

R = TypeVar("R")


class cached_property(Generic[R]):
    """A property that is computed at the first reading, and then is an attribute of the object.

    That of `functools` has on Python 3.11 one lock for all objects of a class, and holds it while it computes. Threads
    wait for one another, and a process that is forked meanwhile waits for ever. This one has no lock: of two threads
    that read at the same time both compute, and one value is kept.

    Parameters
    ----------
    compute
        The method.
    """

    def __init__(self, compute: Callable[[Any], R]) -> None:
        self._compute, self._name, self.__doc__ = compute, compute.__name__, compute.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        """Note the name in the class."""
        self._name = name

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...

    @overload
    def __get__(self, instance: object, owner: type) -> R: ...

    def __get__(self, instance: object | None, owner: type) -> Self | R:
        """The value; Python asks no more once the object has it."""
        if instance is None:
            return self
        value: R = instance.__dict__.setdefault(self._name, self._compute(instance))
        return value
