"""Shares as a person reads them: the only place that rounds them.

A share is rounded to a whole percent, but only all of a thing is 100 %, and only nothing of it is 0 %. So 99.6 % is
written 99 %, and 0.4 % is written 1 %. Files and tables have all digits.
"""

from __future__ import annotations

from math import floor

#: A share below this is nothing: what is left of the rounding of numbers.
LEAST = 1e-9


def percent(share: float) -> str:
    """Write a share: the nearest whole percent, but only all is 100 %, and only nothing is 0 %."""
    whole = floor(100.0 * share + 0.5)
    if whole < 1 and share > LEAST:
        whole = 1
    elif whole == 100 and share < 1.0 - LEAST:
        whole = 99
    return f"{whole} %"


def coverage(covered: float, outside: float) -> str:
    """Write the share of a target that a scene covers, and of the scene that is outside of the target."""
    return f"{percent(covered)} covered, {percent(outside)} outside"
