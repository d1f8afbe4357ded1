"""Memoised functions, which run once in a run of the model for each value of their arguments."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, Generic, ParamSpec, TypeVar, cast

from niwaki.words.running import current, runner

__all__ = ["mem"]

P = ParamSpec("P")
T = TypeVar("T")


class Memoised(Generic[P, T]):
    """A memoised function: in a run, its calls with equal arguments are one call.

    Attributes
    ----------
    function
        The memoised function or model.
    name : str
        The function's part of addresses: `name` in `name(3)/choice`.
    """

    def __init__(self, function: Callable[P, T], name: str) -> None:
        self.function = function
        self.name = name
        functools.update_wrapper(cast(Any, self), function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Call the function in a plain run."""
        return cast(T, runner(self.name).recall(self, args, kwargs))

    def __repr__(self) -> str:
        return f"<memoised function {self.name}>"


def mem(function: Callable[P, T]) -> Memoised[P, T]:
    """Memoise a function: in a run it runs once for each value of its arguments, and later calls return the same value.

    So a property can be drawn where it is first needed: `color(3)` is the colour of ball 3, however many calls need it.
    Above a function of a module, `mem` is a decorator. In a model, `color = mem(paint)` makes a new memoised function
    each time the line runs.

    Parameters
    ----------
    function
        A model function. Its arguments are numbers, truth values, strings, `None`, or tuples and lists of these.
        Arguments are equal if they are written the same, so 1, 1.0 and `True` are three arguments.

    Returns
    -------
    The memoised function.
    """
    run = current.get()
    if run is not None:
        return cast("Memoised[P, T]", run.mem(function))
    name = getattr(function, "__qualname__", getattr(function, "name", "mem"))
    return Memoised(function, name.replace(".<locals>", "").replace("<lambda>", "lambda"))
