"""Checks of settings: which values are numbers, and the error about a value that a setting cannot have."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from math import inf, isfinite
from typing import Any, NoReturn

from niwaki.errors.kinds import InputError
from niwaki.errors.texts.rules import RULES

#: The values that a setting can have, as the engine describes them: `("whole", least, most)`,
#: `("real", low, high, ends)`, `("words", words)`, `("list", range)`, `("table",)`, `("optional", range)` or
#: `("either", range, range)`.
Range = tuple[Any, ...]

#: The largest count: the engine counts in 64 bits.
MOST = 2**63 - 1

#: Counts of the engine that are smaller have a limit that people should know.
THIRTY_TWO_BITS = 2**32 - 1

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
    range = ("whole", least, most)
    raise bad(name, value, worded(range, value), usual or example(range))


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
    raise bad(name, value, worded(("real", low, high, ends)), usual)


def worded(range: Range, value: Any = None) -> str:
    """Describe a range in a message about a value."""
    match range:
        case ("whole", _, most) if is_whole(value) and value > most:
            return f"at most {most}"
        case ("whole", least, most) if most < THIRTY_TWO_BITS:
            return f"a whole number from {least} to {most}"
        case ("whole", least, _):
            special = {0: "a whole number, 0 or more", 1: "a whole number above 0"}
            return special.get(least, f"a whole number, at least {least}")
        case ("real", low, high, ends) if high < inf:
            form = {"()": "between {} and {}", "(]": "above {}, at most {}", "[)": "from {} to below {}"}
            return f"a number {form.get(ends, 'from {} to {}').format(f'{low:g}', f'{high:g}')}"
        case ("real", low, _, ends) if low > -inf:
            return f"a finite number {'above {:g}' if ends[0] == '(' else 'from {:g} on'}".format(low)
        case ("words", words):
            return "one of " + ", ".join(f'"{word}"' for word in words)
        case ("list", inner):
            return f"a list, each entry {worded(inner)}"
        case ("table",):
            return "a `FutureOrder`"
        case ("optional", inner):
            return f"None or {worded(inner, value)}"
        case ("either", first, second):
            return f"{worded(first, value)}, or {worded(second, value)}"
        case _:
            return "a finite number"


def example(range: Range) -> str:
    """Write a value of a range."""
    match range:
        case ("whole", least, _):
            return "0" if least == 0 else f"{least} or more"
        case ("real", low, high, _):
            return f"{(low + high) / 2:g}" if high < inf else "0.5" if low >= 0 else "0"
        case ("words", words):
            return f'"{words[0]}"'
        case ("list", inner):
            return "such a list" if inner[0] == "list" else f"[{example(inner)}]"
        case ("optional" | "either", inner, *_):
            return example(inner)
        case _:
            return "such a value"


def refused(fault: Any, values: Mapping[str, Any], defaults: Mapping[str, Any]) -> InputError:
    """Word the engine's refusal of a setting.

    Parameters
    ----------
    fault
        The engine's fault.
    values
        The settings as a person gave them, by name.
    defaults
        Their defaults, which a message suggests.
    """
    expected = getattr(fault, "expected", None)
    if expected is None:
        return InputError("setting-refused", detail=fault.message, cure=fault.help or "use another value")
    name = fault.subject
    value = shown(values[name]) if name in values else fault.value
    if isinstance(expected, str):
        words, suggestion = RULES[expected]
    else:
        words, default = worded(expected, values.get(name)), defaults.get(name)
        suggestion = (
            example(expected)
            if default is None
            else f'"{default}"'
            if isinstance(default, str)
            else repr(default)
        )
    return InputError("bad-setting", name=name, found=value, expected=words, suggestion=suggestion)


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
