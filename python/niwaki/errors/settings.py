"""Values of settings: what a number is, and the error about a value that a setting cannot have."""

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
