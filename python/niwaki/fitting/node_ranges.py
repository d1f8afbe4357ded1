"""Ranges and conditions of the sockets of a Geometry Nodes modifier.

| socket | range |
| --- | --- |
| a number with both limits | from limit to limit |
| an angle without limits | a whole turn |
| any other number that lacks a limit | from half of its value to twice it |
| such a number at 0 | from -1 to 1; a whole number from 0 to 10 |
| a switch | False or True |
| a menu | its entries |

A limit that there is cuts the usual range.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from niwaki.errors.settings import bad
from niwaki.fitting.in_blender.sockets import Socket
from niwaki.search.space import MOST_LEVELS, Parameter
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Distribution, Uniform

#: The usual ranges of numbers that stand at 0 and lack a limit.
AT_ZERO = {"real": (-1.0, 1.0), "whole": (0.0, 10.0)}


def usual_range(row: Socket) -> Any:
    """Return the range of a socket by its limits and its value; None if there is only one value."""
    if row.kind == "switch":
        return Bernoulli(0.5)
    if row.kind == "menu":
        return list(row.entries) if len(row.entries) > 1 else None
    low, high = row.low, row.high
    has_both = low is not None and high is not None
    if not has_both or (row.kind == "whole" and high - low >= MOST_LEVELS):  # type: ignore[operator]
        low, high = _usual_ends(row)
    assert low is not None and high is not None
    if row.kind == "whole":
        low, high = math.ceil(low), math.floor(high)
        return DiscreteUniform(low, high) if low < high else None
    return Uniform(low, high) if low < high else None


def _usual_ends(row: Socket) -> tuple[float, float]:
    value = float(row.value)
    if row.subtype == "ANGLE":
        ends = (-math.pi, math.pi)
    else:
        ends = AT_ZERO[row.kind] if value == 0.0 else (min(value / 2, 2 * value), max(value / 2, 2 * value))
    low = ends[0] if row.low is None else max(ends[0], row.low)
    high = ends[1] if row.high is None else min(ends[1], row.high)
    if low >= high and row.low is not None:
        return row.low, row.low + max(1.0, abs(row.low))
    if low >= high and row.high is not None:
        return row.high - max(1.0, abs(row.high)), row.high
    return low, high


def given_range(row: Socket, wish: Any) -> Any:
    """Return the range that a person gives to a socket.

    Raises
    ------
    InputError
        `bad-setting`: the output does not depend on the socket, or it cannot have these values.
    """
    if not row.is_used:
        raise bad(row.name, wish, "a socket on which the output of the node tree depends", "another socket")
    inner = wish.range if isinstance(wish, Parameter) else wish
    if not isinstance(inner, Distribution):
        for value in inner:
            kept_value(row, value)
    elif row.kind in ("switch", "menu") and not (row.kind == "switch" and isinstance(inner, Bernoulli)):
        expected = "`Bernoulli(p)`" if row.kind == "switch" else "a list of its entries"
        raise bad(
            row.name, wish, expected, "`nw.Bernoulli(0.5)`" if row.kind == "switch" else str(row.entries)
        )
    return wish


def kept_value(row: Socket, value: Any) -> Any:
    """Return a value that a socket can have.

    Raises
    ------
    InputError
        `bad-setting`.
    """
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if row.kind == "menu":
        if value in row.entries:
            return value
        raise bad(row.name, value, f"one of {', '.join(row.entries)}", repr(row.entries[0]))
    if row.kind == "switch":
        if isinstance(value, bool):
            return value
        raise bad(row.name, value, "True or False", "True")
    if is_number and (row.kind == "real" or value == int(value)):
        return value
    raise bad(row.name, value, "a number" if row.kind == "real" else "a whole number", repr(row.value))


def parameters_of(
    rows: Sequence[Socket], ranges: Mapping[str, Any], kept: Mapping[str, Any]
) -> dict[str, Parameter]:
    """Return the parameters of sockets by name, each after those that decide when it is used.

    Parameters
    ----------
    rows
        All sockets of the modifier.
    ranges
        The ranges of those that are searched, by name.
    kept
        The values of the others by key, where they differ from those of the file.
    """
    by_name = {row.name: row for row in rows}
    ranges = dict(ranges)
    parameters: dict[str, Parameter] = {}
    while waiting := [name for name in ranges if name not in parameters]:
        for name in waiting:
            rules = _rules(by_name[name], rows, ranges, kept)
            if all(other in parameters for rule in rules or () for other in rule):
                break
        else:
            # Sockets that decide about each other count as used always.
            name, rules = waiting[0], []
        if rules is None:
            del ranges[name]
        else:
            range_ = ranges[name]
            parameters[name] = range_ if isinstance(range_, Parameter) else Parameter(range_, rules or None)
    return parameters


def _rules(
    row: Socket, rows: Sequence[Socket], ranges: Mapping[str, Any], kept: Mapping[str, Any]
) -> list[dict[str, list[Any]]] | None:
    """Return when a socket is used, by the names of parameters; None if the values that are kept never use it."""
    decisive = {other.identifier: other for other in rows if other.kind in ("switch", "menu")}
    out: list[dict[str, list[Any]]] = []
    for rule in row.rules:
        conditions: dict[str, list[Any]] = {}
        for identifier, values in rule.items():
            other = decisive[identifier]
            if other.name in ranges:
                known = _values(ranges[other.name])
                conditions[other.name] = [value for value in values if value in known]
                if not conditions[other.name]:
                    break
            elif kept.get(other.key, other.value) not in values:
                break
        else:
            out.append(conditions)
    if row.rules and not out:
        return None
    return out if all(out) else []


def _values(range_: Any) -> Sequence[Any]:
    inner = range_.range if isinstance(range_, Parameter) else range_
    return (False, True) if isinstance(inner, Distribution) else tuple(inner)
