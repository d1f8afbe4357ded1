"""The run that a call belongs to: inside a plain-Python run the functions call the runner, outside they raise.

The compiled engine never calls these functions; it has them by name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextvars import ContextVar
from typing import Any, Protocol

from niwaki.errors import InputError


class Runner(Protocol):
    """What a plain-Python run answers; one method for each effect."""

    def sample(self, dist: Any) -> Any:
        """Make a choice."""
        ...

    def observe(self, dist: Any, value: Any) -> Any:
        """Score a value that was seen."""
        ...

    def factor(self, log_score: float) -> None:
        """Add to the score."""
        ...

    def condition(self, holds: Any) -> None:
        """Forbid the run unless it holds."""
        ...

    def query(self, key: Any, value: Any) -> None:
        """Record an answer."""
        ...

    def emit(self, shapes: Sequence[Any]) -> None:
        """Add a primitive to the scene."""
        ...

    def future(self, function: Callable[..., Any], args: Sequence[Any]) -> Any:
        """Leave a call for later."""
        ...

    def force(self, value: Any) -> Any:
        """Wait for a future."""
        ...

    def mem(self, function: Callable[..., Any]) -> Any:
        """Memoise a function."""
        ...

    def recall(self, function: Any, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """A call of a memoised function."""
        ...

    def infer(self, model: Callable[..., Any], method: Any, args: Sequence[Any], keep: str) -> Any:
        """Search another model."""
        ...

    def constraint(self, kind: str, a: float, b: float, width: float) -> None:
        """Keep what a soft constraint compares."""
        ...


current: ContextVar[Runner | None] = ContextVar("niwaki_runner", default=None)


def runner(word: str) -> Runner:
    """The run that is going on, or an error that names the word."""
    found = current.get()
    if found is None:
        raise InputError("outside-a-model", word=word)
    return found
