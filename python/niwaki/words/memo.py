"""Memoised functions: one call for each value of the arguments in a run, whoever asks."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, Generic, ParamSpec, TypeVar, cast

from niwaki.words.running import current, runner

__all__ = ["mem"]

P = ParamSpec("P")
T = TypeVar("T")


class Memoised(Generic[P, T]):
    """A function whose calls with equal arguments are one call of the run.

    Attributes
    ----------
    function
        The function, or the model, that is memoised.
    name : str
        Its part of addresses: `name` of `name(3)/choice`.
    """

    def __init__(self, function: Callable[P, T], name: str) -> None:
        self.function = function
        self.name = name
        functools.update_wrapper(cast(Any, self), function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """The value of the call, in a plain run."""
        return cast(T, runner(self.name).recall(self, args, kwargs))

    def __repr__(self) -> str:
        return f"<memoised function {self.name}>"


def mem(function: Callable[P, T]) -> Memoised[P, T]:
    """Memoise a function: within a run it is called once for each value of its arguments, which it gives ever after.

    So a property of a thing can be drawn where it is first needed: `color(3)` is the colour of ball 3, however often
    and from wherever it is asked for. Above a function of a module it is a decorator; in a model, `color = mem(paint)`
    is another memoised function at each run of the line.

    Parameters
    ----------
    function
        A model function. Its arguments are numbers, truths, strings, `None`, or tuples and lists of them; they are
        equal when they are written the same, so 1, 1.0 and `True` are three arguments.

    Returns
    -------
    The memoised function.
    """
    run = current.get()
    if run is not None:
        return cast("Memoised[P, T]", run.mem(function))
    name = getattr(function, "__qualname__", getattr(function, "name", "mem"))
    return Memoised(function, name.replace(".<locals>", "").replace("<lambda>", "lambda"))
