"""Functions that are marked for the language: models and host functions.

A marked function keeps its Python function, so that editors, linters and debuggers see ordinary Python.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, ClassVar, Generic, ParamSpec, TypeVar, cast, overload

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
    """A Python function that a model may call although the engine cannot read it; such calls are slow.

    Attributes
    ----------
    threads : bool
        Whether the function may run on several threads at once.
    around : callable or None
        Receives each function with its arguments and calls it, to count the calls of all host functions.
    """

    around: ClassVar[Callable[..., Any] | None] = None

    def __init__(self, function: Callable[P, T], threads: bool = False) -> None:
        super().__init__(function)
        self.threads = threads

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Call the function."""
        around = Host.around
        if around is None:
            return self.function(*args, **kwargs)  # type: ignore[no-any-return]
        return around(self.function, *args, **kwargs)  # type: ignore[no-any-return]

    def __repr__(self) -> str:
        return f"<host function {self.name}>"


@overload
def host(function: Callable[P, T], /) -> Host[P, T]: ...


@overload
def host(*, threads: bool = False) -> Callable[[Callable[P, T]], Host[P, T]]: ...


def host(function: Any = None, /, *, threads: bool = False) -> Any:
    """Mark a Python function as pure, so that a model may call it.

    The function runs in Python, under the interpreter lock, for every call in every particle, which is slow. It must
    return equal results for equal arguments and have no effects; Niwaki does not check this.

    If the function raises an exception, the run is invalid: see `Result.invalid`.

    Parameters
    ----------
    function
        A callable that takes and returns numbers, strings, tuples and lists.
    threads
        Whether the function may run on several threads at once. By default, only one host function of a process runs
        at a time, because many libraries fail when two threads use them.

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
    """Return the function of a model; any other value as it is."""
    return value.function if isinstance(value, Marked) and not isinstance(value, Host) else value
