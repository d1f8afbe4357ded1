"""Values written back into a text: rounded as a person writes them, with comments and formatting kept."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from niwaki.repairing.literals import Literal

#: Steps to which a value is rounded, coarsest first, as shares of a power of ten.
STEPS = (1.0, 0.5, 0.1)
#: A value is rounded up to this share of its change.
ROUNDED = 0.2


def written(text: str, rows: Mapping[str, Literal], values: Mapping[str, float]) -> str:
    """Write values into a text; a literal whose value is as before stays as it is written."""
    for key in sorted(values, key=lambda key: -rows[key].start):
        row = rows[key]
        if values[key] == row.value:
            continue
        new, operator = spelled(row, values[key])
        text = text[: row.start] + new + text[row.end :]
        if operator:
            text = text[: row.sign] + operator + text[row.sign + 1 :]
    return text


def spelled(row: Literal, value: float) -> tuple[str, str]:
    """Return how a value is written, and the operator before it, empty if that stays."""
    if row.words:
        return row.words[int(value)], ""
    if row.sign >= 0:
        return digits(row, abs(value)), "-" if value < 0 else "+"
    return digits(row, value), ""


def digits(row: Literal, value: float) -> str:
    """Return the digits of a value, as whole or as real as the literal was."""
    if row.kind == "count":
        return str(int(round(value)))
    if row.is_whole and value == int(value):
        return str(int(value))
    text = f"{value:.10g}"
    if "e" in text or float(text) != value:
        return repr(value)
    return text if "." in text or row.is_whole else f"{text}.0"


def rounded(start: float, value: float, original: float | None = None) -> list[float]:
    """Return values like one, further from `start`, with few digits: the coarsest first that is near, then finer.

    Parameters
    ----------
    start
        A value that is not far enough.
    value
        A value that is far enough from it.
    original
        The value as written, if it is another.
    """
    start, value = float(start), float(value)
    change = value - start
    if change == 0.0 or not math.isfinite(value):
        return []
    out: list[float] = []
    far = max(abs(change), 0.0 if original is None else abs(value - original))
    power = math.floor(math.log10(far)) + 1
    for exponent in range(power, power - 5, -1):
        for share in STEPS[:2] if exponent > power - 4 else STEPS[:1]:
            step = share * 10.0**exponent
            count = value / step
            near = math.ceil(count - 1e-7) if change > 0 else math.floor(count + 1e-7)
            result = float(f"{near * step:.12g}")
            if abs(result - value) <= ROUNDED * far and result not in out:
                out.append(result)
                if len(out) == 2:
                    return out
    return out or [value]


def further(row: Literal, value: float) -> int:
    """Return how many more decimals a value has than its literal as it is written."""
    return max(0, decimals(digits(row, value)) - max(decimals(row.text), 1 if abs(row.value) < 100 else 0))


def decimals(text: str) -> int:
    """Return the number of digits behind the point."""
    return len(text.rpartition(".")[2].rstrip("0")) if "." in text else 0


def coarse(row: Literal, start: float, value: float) -> float:
    """Return a value with as many decimals as its literal, further from `start`."""
    step = 10.0 ** -max(decimals(row.text), 1 if abs(row.value) < 100 and not row.is_whole else 0)
    count = value / step
    near = math.ceil(count - 1e-7) if value > start else math.floor(count + 1e-7)
    return float(f"{near * step:.12g}")


def changed(rows: Sequence[Literal], values: Mapping[str, float]) -> list[Literal]:
    """Return the literals that values change, in the order of the text."""
    return [row for row in rows if row.key in values and values[row.key] != row.value]
