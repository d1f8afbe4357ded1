"""`@model` marks a Python function as a model; `@host` marks one that the engine calls as it is.

A model keeps its function, so that editors, linters and debuggers see ordinary Python.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from types import FunctionType
from typing import TYPE_CHECKING, Any, Generic, ParamSpec, TypeVar, cast

if TYPE_CHECKING:
    from niwaki._engine import Program
    from niwaki.lang.core import Core

P = ParamSpec("P")
T = TypeVar("T")


class Model(Generic[P, T]):
    """A function that can be run forwards, searched and drawn.

    Attributes
    ----------
    name : str
        The function's name.
    function : FunctionType
        The Python function as it was written.
    """

    def __init__(self, function: Callable[P, T]) -> None:
        if not isinstance(function, FunctionType):
            from niwaki.errors import InputError

            raise InputError("model-of-a-value", found=repr(function))
        self.function: FunctionType = function
        self.name: str = function.__name__
        self._core: Core | None = None
        self._program: Program | None = None
        functools.update_wrapper(self, function)

    def core(self) -> Core:
        """The model in core form, compiled at the first call and kept."""
        if self._core is None:
            from niwaki.lang.lower import lower

            self._core = lower(self.function)
        return self._core

    def program(self) -> Program:
        """The model compiled for the engine; kept, like its core form."""
        if self._program is None:
            from niwaki.lang.compiled import compile_core

            self._program = compile_core(self.core())
        return self._program

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Run the model once as plain Python with a fresh seed, and keep only its value."""
        from niwaki.lang.plain import run

        return cast(T, run(self.function, args, kwargs).value)

    def __repr__(self) -> str:
        return f"<model {self.name}>"


def model(function: Callable[P, T]) -> Model[P, T]:
    """Mark a function as a model.

    Parameters
    ----------
    function
        A function written in the modelling language.

    Examples
    --------
    >>> from niwaki.words import model
    >>> @model
    ... def half(x):
    ...     return x / 2
    >>> half
    <model half>
    """
    return Model(function)


class Host(Generic[P, T]):
    """A Python function that a model may call although the engine cannot read it; the slow way."""

    def __init__(self, function: Callable[P, T]) -> None:
        self.function = function
        self.name: str = getattr(function, "__name__", "host")
        functools.update_wrapper(self, function)

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Call the function."""
        return self.function(*args, **kwargs)

    def __repr__(self) -> str:
        return f"<host function {self.name}>"


def host(function: Callable[P, T]) -> Host[P, T]:
    """Mark a Python function as pure, so that a model may call it as it is.

    It runs under Python's interpreter lock, once for every call in every particle: the slow way. It must give equal
    results for equal arguments and change nothing; nobody checks.

    Parameters
    ----------
    function
        Any callable that takes and gives numbers, strings, tuples and lists.
    """
    return Host(function)


def underlying(value: Any) -> Any:
    """The function of a model, anything else as it is."""
    return value.function if isinstance(value, Model) else value
