"""Functions that are marked for the language: what a model and a host function have in common.

A marked function keeps its Python function, so that editors, linters and debuggers see ordinary Python.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, Generic, ParamSpec, TypeVar, cast, overload

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
    """A Python function that a model may call although the engine cannot read it; this is slow.

    Attributes
    ----------
    threads : bool
        Whether it may run on several threads at once.
    """

    def __init__(self, function: Callable[P, T], threads: bool = False) -> None:
        super().__init__(function)
        self.threads = threads

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Call the function."""
        return self.function(*args, **kwargs)  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return f"<host function {self.name}>"


@overload
def host(function: Callable[P, T], /) -> Host[P, T]: ...


@overload
def host(*, threads: bool = False) -> Callable[[Callable[P, T]], Host[P, T]]: ...


def host(function: Any = None, /, *, threads: bool = False) -> Any:
    """Mark a Python function as pure, so that a model may call it as it is.

    It runs under Python's interpreter lock, once for every call in every particle, which is slow. It must give equal
    results for equal arguments and change nothing; this is not checked.

    Where it raises an exception, the run is invalid: see `Result.invalid`.

    Parameters
    ----------
    function
        Any callable that takes and gives numbers, strings, tuples and lists.
    threads
        Whether the function may run on several threads at once. Left out, one host function runs at a time in a
        process, because many libraries break where two threads are inside of them.

    Examples
    --------
    >>> import niwaki as nw
    >>> @nw.host(threads=True)
    ... def area(radius: float) -> float:
    ...     return 3.14 * radius * radius
    >>> area(1.0)
    3.14
    """
    return Host(function, threads) if function is not None else functools.partial(Host, threads=threads)


def underlying(value: Any) -> Any:
    """The function of a model, anything else as it is."""
    return value.function if isinstance(value, Marked) and not isinstance(value, Host) else value
