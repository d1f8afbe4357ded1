"""Memoised functions of a plain run: the calls so far, by function and by the text of the arguments.

The engine has the same texts (`machine/memo.rs`), so that an address names the same call.
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
        """The function's part of addresses: its name, with its module where another function has that name."""
        name = memo.name
        if self.names.setdefault(name, memo) is not memo:
            name = f"{public(underlying(memo.function).__module__)}.{name}"
        return name


def bound(memo: Memoised[..., Any], args: Sequence[Any], kwargs: Mapping[str, Any]) -> list[Any]:
    """The arguments in the order of the parameters, with those left out."""
    signature = inspect.signature(underlying(memo.function))
    given = signature.bind(*args, **kwargs)
    given.apply_defaults()
    return list(given.arguments.values())


def text_of(values: Sequence[Any]) -> str:
    """The text of arguments, by which they are compared. No component of an address has a slash inside."""
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
    """Whether one of the values is a memoised function or holds one."""
    return any(isinstance(value, Memoised) or holds_one(futures.parts_of(value)) for value in values)
