"""Parameters of an OpenSCAD file, from the comments of its Customizer.

| line of the file | parameter |
| --- | --- |
| `count = 4; // [1:12]` | a whole number, if ends and step are whole and there are at most 50 steps |
| `width = 40; // [20:80]`, `width = 40; // [20:0.5:80]` | else a real number |
| `count = 3; // [1, 2, 5]`, `kind = "a"; // [a:Round, b:Flat]` | a choice |
| `back = true;` | a switch |
| `wall = 2.5;` | a real number without a range: from half of it to twice it |
| `name = "text";`, `gap = 0;`, `size = [1, 2];` | none: it keeps its value, unless `nw.scad` gets a range for it |

Lines below `/* [Hidden] */`, and those from the first module, function or block on, are no parameters.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from niwaki.fitting.functions import usual_range
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Uniform

#: `name = value; // comment`.
LINE = re.compile(r"^\s*(\$?\w+)\s*=\s*([^;]+?)\s*;[ \t]*(?://[ \t]*(.*?))?\s*$")
NUMBER = re.compile(r"^[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?$")
HIDDEN = re.compile(r"/\*\s*\[\s*hidden\s*\]\s*\*/", re.IGNORECASE)
#: The most steps of a whole number; a slider with more is a length, an angle or the like.
MOST_STEPS = 50
#: The first line of code: there the Customizer stops.
CODE = re.compile(r"^\s*(?:module|function)\b|^[^/]*\{")


@dataclass(frozen=True)
class Slot:
    """An assignment of a file.

    Attributes
    ----------
    name : str
        Its name.
    range : object
        A distribution, or the values of a choice; None for a value without a range.
    line : int
        The line of its assignment, from 0.
    """

    name: str
    range: Any
    line: int


def slots(text: str) -> list[Slot]:
    """Return the assignments of a file to which values can be given, in the order of their lines."""
    rows: dict[str, Slot] = {}
    for number, line in enumerate(text.splitlines()):
        if HIDDEN.search(line) or CODE.search(line):
            break
        match = LINE.match(line)
        if match is None or match[1].startswith("$") or match[1] in rows:
            continue
        rows[match[1]] = Slot(match[1], _range(match[1], match[2], match[3] or ""), number)
    return list(rows.values())


def written(text: str, values: dict[str, tuple[int, str]]) -> str:
    """Write values into the assignments of a file.

    Parameters
    ----------
    text
        The file.
    values
        Line and new value by name.
    """
    lines = text.splitlines()
    for name, (number, value) in values.items():
        lines[number] = f"{name} = {value};"
    return "\n".join(lines) + "\n"


def _range(name: str, value: str, comment: str) -> Any:
    if value in ("true", "false"):
        return Bernoulli(0.5)
    inside = re.match(r"^\[(.*)\]", comment)
    is_number, is_text = bool(NUMBER.match(value)), bool(re.match(r'^"[^"]*"$', value))
    if not (is_number or is_text):
        return None
    if inside is not None:
        return _listed(inside[1], value, is_text)
    if not is_number or float(value) == 0.0:
        return None
    return usual_range("", name, float(value))


def _listed(inside: str, value: str, is_text: bool) -> Any:
    """Return the range of what stands between brackets."""
    parts = [part.strip() for part in inside.split(",")]
    ends = [part.strip() for part in inside.split(":")]
    if len(parts) == 1 and len(ends) in (2, 3) and all(map(NUMBER.match, ends)):
        low, high = float(ends[0]), float(ends[-1])
        numbers = [low, high, float(ends[1]) if len(ends) == 3 else 1.0]
        if not low < high:
            return None
        is_whole = all(number == int(number) for number in numbers) and "." not in value
        if is_whole and numbers[2] == 1.0 and high - low <= MOST_STEPS:
            return DiscreteUniform(int(low), int(high))
        return Uniform(low, high)
    if len(parts) == 1 and len(ends) == 1:
        # A number alone is the largest value of a slider.
        return Uniform(0.0, float(parts[0])) if NUMBER.match(parts[0]) and float(parts[0]) > 0 else None
    words = [part.partition(":")[0].strip().strip('"') for part in parts]
    return words if is_text else [_number(word) for word in words]


def _number(word: str) -> float | int | str:
    if not NUMBER.match(word):
        return word
    return float(word) if any(character in word for character in ".eE") else int(word)
