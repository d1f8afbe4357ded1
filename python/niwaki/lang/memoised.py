"""Memoised calls of a plain run, by function and by the text of the arguments.

The engine makes the same texts (`machine/memo.rs`), so that addresses agree.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from types import FunctionType
from typing import Any

import numpy as np

from niwaki.errors import ModelFault
from niwaki.inputs.modules import public
from niwaki.lang import futures
from niwaki.lang.marks import underlying
from niwaki.words.memo import Memoised

#: The value of a call that has not returned.
RUNNING = object()


class Calls:
    """The memoised calls of a run."""

    def __init__(self) -> None:
        self.values: dict[str, Any] = {}
        self.names: dict[str, Memoised[..., Any]] = {}

    def address(self, memo: Memoised[..., Any]) -> str:
        """Return a function's component of addresses: its name, with its module if another function has the name."""
        name = memo.name
        if self.names.setdefault(name, memo) is not memo:
            name = f"{public(underlying(memo.function).__module__)}.{name}"
        return name


def bound(memo: Memoised[..., Any], args: Sequence[Any], kwargs: Mapping[str, Any]) -> list[Any]:
    """Return the arguments in the order of the parameters, with defaults filled in."""
    signature = inspect.signature(underlying(memo.function))
    arguments = signature.bind(*args, **kwargs)
    arguments.apply_defaults()
    return list(arguments.arguments.values())


def text_of(values: Sequence[Any]) -> str:
    """Return the text of arguments, by which calls are compared; slashes are escaped, because a component has none."""
    return f"({', '.join(_written(value) for value in values)})".replace("/", "\\x2f")


def _written(value: Any) -> str:
    if isinstance(value, np.generic):
        value = value.item()
    if type(value) in (list, tuple):
        inside = ", ".join(_written(part) for part in value)
        if type(value) is list:
            return f"[{inside}]"
        return f"({inside},)" if len(value) == 1 else f"({inside})"
    if value is None or type(value) in (bool, int, float, str):
        return repr(value)
    if type(value) is futures.Future:
        raise futures.NotForced("a future cannot be an argument of a memoised function")
    kind = (
        "a function"
        if isinstance(value, (FunctionType, Memoised))
        else f"a value of `{type(value).__name__}`"
    )
    raise ModelFault("memo-argument", f"{kind} cannot be an argument of a memoised function")


def holds_one(values: Sequence[Any]) -> bool:
    """Return whether a value is a memoised function or contains one."""
    return any(isinstance(value, Memoised) or holds_one(futures.parts_of(value)) for value in values)
