"""What the settings of methods are checked for."""

from __future__ import annotations

from typing import Any

from niwaki.errors import InputError


def bad(name: str, found: Any, expected: str, suggestion: str) -> InputError:
    """Say what a setting cannot be."""
    return InputError("bad-setting", name=name, found=repr(found), expected=expected, suggestion=suggestion)


def is_whole(value: Any) -> bool:
    """Whether it is a whole number, which a truth value is not."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Whether it is a number, which a truth value is not."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def at_least_one(name: str, value: int) -> int:
    """The value, where it is a whole number above zero."""
    if not is_whole(value) or value < 1:
        raise InputError(
            "bad-setting",
            name=name,
            found=repr(value),
            expected="a whole number above 0",
            suggestion="1 or more",
        )
    return value


def one_of(name: str, value: str, known: tuple[str, ...]) -> None:
    """Refuse a word that is not known."""
    if value not in known:
        listed = ", ".join(f'"{one}"' for one in known)
        raise InputError(
            "bad-setting",
            name=name,
            found=repr(value),
            expected=f"one of {listed}",
            suggestion=f'"{known[0]}"',
        )
