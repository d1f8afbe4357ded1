"""Futures of a plain run: their values exist, but only `force` returns them.

In the engine the value of a future may not exist yet, so any use of it without `force` is an error. A plain run reports
the same error for the same use.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from types import FunctionType
from typing import Any

from niwaki import words
from niwaki.lang import vocabulary

#: Special methods, which Python calls without looking up an attribute of the object.
_LOOKS = """bool eq ne lt le gt ge hash len iter next contains getitem call str repr format int float complex index
round trunc floor ceil abs neg pos invert reversed divmod rdivmod array"""
_OPERATORS = "add sub mul matmul truediv floordiv mod pow and or xor lshift rshift"
#: Functions that take futures without using their values.
_PASSING = frozenset(
    {
        words.arrayed,
        words.choose,
        words.force,
        words.future,
        words.mem,
        words.mirrored,
        words.place,
        words.query,
    }
)


class NotForced(Exception):
    """Error about a future that is read before it is forced."""


class Future:
    """A future of a plain run, with its value."""

    __slots__ = ("held",)

    def __init__(self, value: Any) -> None:
        self.held = value

    def __getattribute__(self, name: str) -> Any:
        if name == "__class__":
            return Future
        raise NotForced(f"a future has no field `{name}`")


def _refuse(*_: Any) -> Any:
    raise NotForced("a future is not the value that it will have")


for _name in (*_LOOKS.split(), *(f"{side}{name}" for name in _OPERATORS.split() for side in ("", "r"))):
    setattr(Future, f"__{_name}__", _refuse)


def forced(value: Any) -> Any:
    """Return the value of a future; any other value as it is."""
    return object.__getattribute__(value, "held") if type(value) is Future else value


def opened(value: Any) -> Any:
    """Return a value with the futures in it replaced by their values, when it leaves the run."""
    value = forced(value)
    if not holds_future(value):
        return value
    if isinstance(value, (list, tuple)):
        parts = [opened(part) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else type(value)(parts)
    if isinstance(value, dict):
        return {key: opened(part) for key, part in value.items()}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        parts = [opened(getattr(value, field.name)) for field in dataclasses.fields(value)]
        return type(value)(*parts)
    return value


def holds_future(*values: Any) -> bool:
    """Return whether a value is a future or contains a future, at any depth."""
    work, seen = list(values), set()
    while work:
        value = work.pop()
        if type(value) is Future:
            return True
        parts = parts_of(value)
        if parts and id(value) not in seen:
            seen.add(id(value))
            work.extend(parts)
    return False


def parts_of(value: Any) -> Sequence[Any]:
    """Return the values inside a value."""
    if isinstance(value, (list, tuple)):
        return value
    if isinstance(value, dict):
        return [*value.values()]
    if isinstance(value, FunctionType):
        return [cell.cell_contents for cell in value.__closure__ or () if _is_filled(cell)]
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return [getattr(value, field.name) for field in dataclasses.fields(value)]
    return ()


def _is_filled(cell: Any) -> bool:
    try:
        return cell.cell_contents is not cell
    except ValueError:
        return False


def compared(value: Any) -> Any:
    """Return a side of a comparison; refuse a future, and a value that contains a future."""
    if holds_future(value):
        raise NotForced("a future cannot be compared")
    return value


def searched(value: Any) -> Any:
    """Return the right side of `in`; for a dict only the keys are compared."""
    return value if isinstance(value, dict) else compared(value)


def refuse(function: Callable[..., Any], args: Iterable[Any], keywords: Mapping[str, Any]) -> None:
    """Refuse futures as arguments of functions that are not model code and use their arguments."""
    if function in _PASSING:
        return
    owner, name = getattr(function, "__self__", None), getattr(function, "__name__", "")
    values = [*args, *keywords.values()]
    if isinstance(owner, dict):
        values = values[:1]
    if function in vocabulary.ALL_WORDS or isinstance(owner, str):
        has_future = holds_future(*values)
    elif isinstance(owner, (list, tuple)):
        has_future = holds_future(owner, *values)
    elif isinstance(function, type) and (hasattr(function, "_fields") or dataclasses.is_dataclass(function)):
        return
    else:
        has_future = any(type(part) is Future for part in values)
    if has_future:
        raise NotForced(f"`{name}` reads a future")
