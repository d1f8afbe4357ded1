"""Values of settings: what a number is, and the error about a value that a setting cannot have."""

from __future__ import annotations

import os
import sys
from math import inf, isfinite
from typing import Any, NoReturn

from niwaki.errors.kinds import InputError

#: The largest count: the engine counts in 64 bits.
MOST = 2**63 - 1

#: What a run may use where nobody says otherwise: calls and loop steps, and bytes.
MAX_STEPS, MAX_MEMORY = 20_000_000, 1 << 30

#: The most threads of a search, and the variable in the environment that names their number.
THREADS, VARIABLE = 1024, "RAYON_NUM_THREADS"

#: The most characters of a value in a message.
LONGEST = 200


def bad(name: str, found: Any, expected: str, suggestion: str) -> InputError:
    """The error about the value of a setting."""
    return InputError("bad-setting", name=name, found=shown(found), expected=expected, suggestion=suggestion)


def shown(value: Any) -> str:
    """A value as a message shows it: of a long one the beginning, of a huge number the number of its digits."""
    if is_whole(value) and value.bit_length() > 256:
        return f"a number of about {round(value.bit_length() * 0.30103)} digits"
    try:
        text = repr(value)
    except (ValueError, RecursionError):
        # Whole numbers of many digits within a value, and values within values, that Python refuses to write.
        return "a value too long to write"
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}..."


def is_whole(value: Any) -> bool:
    """Whether it is a whole number, which a truth value is not."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Whether it is a number that a real number can hold, which a truth value is not."""
    return isinstance(value, float) or (is_whole(value) and abs(value) <= sys.float_info.max)


def count(name: str, value: Any, least: int = 1, most: int = MOST, usual: str | None = None) -> int:
    """The value, where it is a whole number within these bounds; else the error about it.

    Parameters
    ----------
    name
        The setting, as the person wrote it.
    value
        What was given.
    least, most
        The bounds, both allowed.
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
    """The value as a real number, where it is finite and within these bounds; else the error about it.

    Parameters
    ----------
    name
        The setting, as the person wrote it.
    value
        What was given.
    low, high
        The bounds.
    ends
        Whether they are allowed: "[]" for both, "()" for none.
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
    """How many threads the environment asks for; None where it does not say. The engine calls it for each of its pools.

    Raises
    ------
    InputError
        The variable is no number of threads.
    """
    text = os.environ.get(VARIABLE, "").strip()
    # Zero is Rayon's word for as many as the machine has.
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


def refuse_threads(asked: int | None, reason: str) -> NoReturn:
    """The error about threads that the system does not give, in the engine's words."""
    raise InputError("no-threads", asked="all" if asked is None else asked, reason=reason)
