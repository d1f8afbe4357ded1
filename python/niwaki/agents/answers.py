"""Answers: events as texts of lines, in pages of at most 4 kB.

Each event is a line with its kind and its short fields as JSON. A list has a line for each entry. Fields that are
empty or have their default values are left out, numbers have six digits, and a place in a file is `path:line:column`.
The text of a problem is as the shell prints it.
"""

from __future__ import annotations

import json
from typing import Any

import msgspec
import numpy as np

from niwaki.studio.messages import Difference, Event, Failed, Place, Problem

#: The most bytes of a page.
PAGE = 4_000
#: Bytes that a line about the call takes.
HEAD = 240
#: Values of fields that an answer leaves out.
EMPTY: tuple[Any, ...] = (None, "", [], {})


def lines(event: Event) -> list[str]:
    """Return the lines of an event."""
    if isinstance(event, Failed) and event.problem is not None:
        return problem_lines(event.problem)
    kind = str(event.__struct_config__.tag)
    return [
        kind,
        *_rows({name: value for name, value in _plain(event).items() if name not in ("id", "kind")}),
    ]


def problem_lines(problem: Problem) -> list[str]:
    """Return the lines of a problem: its code, its place in a file, and its text."""
    where = "" if problem.place is None else f" at {_short(problem.place)}"
    return [f"error {problem.code}{where}", *problem.text.splitlines()]


#: Words for the values of a cell of a difference.
CELLS = {1: "both", 2: "target_only", 3: "scene_only"}


def difference_lines(event: Difference, cells: bytes) -> list[str]:
    """Return the lines of a difference: for each kind of cells, their number and corners around them."""
    values = np.frombuffer(cells, np.uint8).reshape(event.size[::-1])
    low, high = np.array(event.low), np.array(event.high)
    step = (high - low) / np.array(event.size)
    fields: dict[str, Any] = {}
    for value, name in CELLS.items():
        places = np.argwhere(values == value)[:, ::-1]
        fields[name] = {"cells": len(places)}
        if len(places) and not event.is_picture:
            first, last = low + places.min(axis=0) * step, low + (places.max(axis=0) + 1) * step
            fields[name] |= {"low": _short(first.tolist()), "high": _short(last.tolist())}
    return [*lines(event), *_rows(fields)]


def field_lines(values: dict[str, Any]) -> list[str]:
    """Return the lines of fields by name."""
    return _rows(_short(values))


def pages(text_lines: list[str]) -> list[str]:
    """Divide lines into pages; a line that is longer than a page continues on the next one."""
    room, divided, size = PAGE - HEAD, [[]], 0  # type: ignore[var-annotated]
    for line in text_lines:
        for piece in _pieces(line, room - 1):
            length = len(piece.encode()) + 1
            if size + length > room and divided[-1]:
                divided.append([])
                size = 0
            divided[-1].append(piece)
            size += length
    return ["\n".join(page) for page in divided]


def _pieces(line: str, room: int) -> list[str]:
    """Cut a line into pieces of at most `room` bytes."""
    data = line.encode()
    if len(data) <= room:
        return [line]
    # A character has at most four bytes.
    step = room // 4
    return [line[start : start + step] for start in range(0, len(line), step)]


def _rows(values: dict[str, Any]) -> list[str]:
    """Return a line for each field; a list of tables has a line for each table."""
    rows = []
    for name, value in values.items():
        if isinstance(value, list) and value and any(isinstance(entry, dict | list) for entry in value):
            rows += [f"{name}:", *(f"  {_json(entry)}" for entry in value)]
        elif isinstance(value, dict) and len(_json(value)) > 200:
            rows += [f"{name}:", *(f"  {line}" for line in _rows(value))]
        elif isinstance(value, str) and "\n" in value:
            rows += [f"{name}:", *(f"  {line}" for line in value.splitlines())]
        else:
            rows.append(f"{name}: {_json(value)}")
    return rows


def _plain(struct: msgspec.Struct) -> dict[str, Any]:
    """Return the fields of a struct that differ from their defaults, as plain data."""
    data = {}
    for field in msgspec.structs.fields(type(struct)):
        value = getattr(struct, field.name)
        if field.default_factory is not msgspec.NODEFAULT:
            is_default = value == field.default_factory()
        else:
            is_default = field.default is not msgspec.NODEFAULT and value == field.default
        if not is_default:
            data[field.encode_name] = _short(value)
    return data


def _short(value: Any) -> Any:
    """Return a value as plain data, with numbers of six digits and without fields that have their defaults."""
    if isinstance(value, Place):
        return f"{value.path}:{value.line}:{value.column}"
    if isinstance(value, msgspec.Struct):
        return _plain(value)
    if isinstance(value, dict):
        shortened = {name: _short(entry) for name, entry in value.items()}
        return {name: entry for name, entry in shortened.items() if entry not in EMPTY}
    if isinstance(value, list | tuple):
        return [_short(entry) for entry in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"), default=str)
