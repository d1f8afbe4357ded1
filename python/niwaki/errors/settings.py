"""Checks of settings: which values are numbers, and the error about a value that a setting cannot have."""

from __future__ import annotations

import os
import sys
from math import inf, isfinite
from typing import Any, NoReturn

from niwaki.errors.kinds import InputError

#: The largest count: the engine counts in 64 bits.
MOST = 2**63 - 1

#: Default limits of a run: steps (calls and loop iterations), and bytes.
MAX_STEPS, MAX_MEMORY = 20_000_000, 1 << 30

#: The most threads of a search, and the environment's variable for their number.
THREADS, VARIABLE = 1024, "RAYON_NUM_THREADS"

#: The most characters of a value in a message.
LONGEST = 200


def bad(name: str, value: Any, expected: str, suggestion: str) -> InputError:
    """Return the error about the value of a setting."""
    return InputError("bad-setting", name=name, found=shown(value), expected=expected, suggestion=suggestion)


def shown(value: Any) -> str:
    """Return a value as messages show it: the beginning of a long text, the number of digits of a huge number."""
    if is_whole(value) and value.bit_length() > 256:
        return f"a number of about {round(value.bit_length() * 0.30103)} digits"
    try:
        text = repr(value)
    except (ValueError, RecursionError):
        # Python refuses to write a value that has a number of very many digits, or that is nested very deeply.
        return "a value too long to write"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def is_whole(value: Any) -> bool:
    """Return whether a value is a whole number; truth values are not."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Return whether a value is a number within the range of floats; truth values are not."""
    return isinstance(value, float) or (is_whole(value) and abs(value) <= sys.float_info.max)


def count(name: str, value: Any, least: int = 1, most: int = MOST, usual: str | None = None) -> int:
    """Check that a value is a whole number within bounds, and return it.

    Parameters
    ----------
    name
        The setting's name, as the user wrote it.
    value
        The setting's value.
    least, most
        The bounds, inclusive.
    usual
        A value that makes sense, for the message.
    """
    if is_whole(value) and least <= value <= most:
        return int(value)
    if is_whole(value) and value > most:
        raise bad(name, value, f"at most {most}", usual or "a smaller number")
    expected = {0: "a whole number, 0 or more", 1: "a whole number above 0"}
    suggestion = usual or ("0" if least == 0 else f"{least} or more")
    raise bad(name, value, expected.get(least, f"a whole number, at least {least}"), suggestion)


def real(
    name: str,
    value: Any,
    low: float = -inf,
    high: float = inf,
    ends: str = "()",
    usual: str = "such a number",
) -> float:
    """Check that a value is a finite number within bounds, and return it as a float.

    Parameters
    ----------
    name
        The setting's name, as the user wrote it.
    value
        The setting's value.
    low, high
        The bounds.
    ends
        "[]" if the bounds are inclusive, "()" if they are exclusive; also "[)" and "(]".
    usual
        A value that makes sense, for the message.
    """
    if is_number(value) and isfinite(value):
        above = value >= low if ends[0] == "[" else value > low
        if above and (value <= high if ends[1] == "]" else value < high):
            return float(value)
    if high < inf:
        form = {"()": "between {} and {}", "(]": "above {}, at most {}", "[)": "from {} to below {}"}
        expected = f"a number {form.get(ends, 'from {} to {}').format(f'{low:g}', f'{high:g}')}"
    elif low > -inf:
        expected = f"a finite number {'above {:g}' if ends[0] == '(' else 'from {:g} on'}".format(low)
    else:
        expected = "a finite number"
    raise bad(name, value, expected, usual)


def usual_threads() -> int | None:
    """Return the number of threads that the environment sets, or None. The engine calls this for each of its pools.

    Raises
    ------
    InputError
        The variable is not a number of threads.
    """
    text = os.environ.get(VARIABLE, "").strip()
    # Zero means all cores, as in Rayon.
    if text in ("", "0"):
        return None
    if not (text.isascii() and text.isdecimal() and len(text) <= 4 and int(text) <= THREADS):
        raise bad(
            VARIABLE,
            text,
            f"a whole number from 1 to {THREADS}",
            "such a number, or leave it out for all cores",
        )
    return int(text)


def refuse_threads(count: int | None, reason: str) -> NoReturn:
    """Raise the error about threads that the system refuses; the engine calls this."""
    raise InputError("no-threads", asked="all" if count is None else count, reason=reason)
