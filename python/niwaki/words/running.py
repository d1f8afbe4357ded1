"""The current plain-Python run, which the words call; outside of a run they raise an error.

The engine never calls the words' Python functions; the compiler recognises them by name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextvars import ContextVar
from typing import Any, Protocol

from niwaki.errors import InputError


class Runner(Protocol):
    """Interface of a plain-Python run, with a method for each effect."""

    def sample(self, dist: Any, words: Sequence[str] | None = None) -> Any:
        """Make a choice; words name its numbers in the record of the run."""
        ...

    def observe(self, dist: Any, value: Any) -> Any:
        """Score an observed value."""
        ...

    def factor(self, log_score: float) -> None:
        """Add to the score."""
        ...

    def condition(self, holds: Any) -> None:
        """Forbid the run unless `holds`."""
        ...

    def query(self, key: Any, value: Any) -> None:
        """Record the answer of a query."""
        ...

    def emit(self, shapes: Sequence[Any]) -> None:
        """Add shapes to the scene."""
        ...

    def future(self, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Postpone a call."""
        ...

    def place(self, frame: Any, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Call a function in a frame."""
        ...

    def mirrored(self, axis: Any, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Call a function as it is, and reflected."""
        ...

    def arrayed(self, frames: Any, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Call a function in each of several frames."""
        ...

    def force(self, value: Any) -> Any:
        """Return the value of a future."""
        ...

    def mem(self, function: Callable[..., Any]) -> Any:
        """Memoise a function."""
        ...

    def recall(self, function: Any, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """Call a memoised function."""
        ...

    def infer(self, model: Callable[..., Any], method: Any, args: Sequence[Any], keep: str) -> Any:
        """Search another model."""
        ...

    def constraint(self, kind: str, a: float, b: float, width: float) -> None:
        """Record the numbers that a soft constraint compares."""
        ...


current: ContextVar[Runner | None] = ContextVar("niwaki_runner", default=None)


def runner(word: str) -> Runner:
    """Return the current run, or raise the error that names the word."""
    run = current.get()
    if run is None:
        raise InputError("outside-a-model", word=word)
    return run
