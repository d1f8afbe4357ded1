"""Values of settings: what a number is, and the error about a value that a setting cannot have."""

from __future__ import annotations

from typing import Any

from niwaki.errors.kinds import InputError


def bad(name: str, found: Any, expected: str, suggestion: str) -> InputError:
    """The error about the value of a setting."""
    return InputError("bad-setting", name=name, found=repr(found), expected=expected, suggestion=suggestion)


def is_whole(value: Any) -> bool:
    """Whether it is a whole number, which a truth value is not."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Whether it is a number, which a truth value is not."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def shown(value: Any) -> str:
    """A value for a message: its first 60 characters."""
    try:
        return f"{value!r:.60}"
    except (ValueError, RecursionError):
        # Python refuses to write whole numbers of many digits.
        return "a value too long to write"
