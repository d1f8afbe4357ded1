"""Functions that are marked for the language: what a model and a host function have in common.

A marked function keeps its Python function, so that editors, linters and debuggers see ordinary Python.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, Generic, ParamSpec, TypeVar, cast

P = ParamSpec("P")
T = TypeVar("T")


class Marked(Generic[P, T]):
    """A Python function with a mark.

    Attributes
    ----------
    name : str
        The function's name.
    """

    def __init__(self, function: Callable[P, T]) -> None:
        self.function: Any = function
        self.name: str = getattr(function, "__name__", "host")
        functools.update_wrapper(cast(Any, self), function)


class Host(Marked[P, T]):
    """A Python function that a model may call although the engine cannot read it; this is slow."""

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Call the function."""
        return self.function(*args, **kwargs)  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return f"<host function {self.name}>"


def host(function: Callable[P, T]) -> Host[P, T]:
    """Mark a Python function as pure, so that a model may call it as it is.

    It runs under Python's interpreter lock, once for every call in every particle, which is slow. It must give equal
    results for equal arguments and change nothing; this is not checked.

    Parameters
    ----------
    function
        Any callable that takes and gives numbers, strings, tuples and lists.
    """
    return Host(function)


def underlying(value: Any) -> Any:
    """The function of a model, anything else as it is."""
    return value.function if isinstance(value, Marked) and not isinstance(value, Host) else value
