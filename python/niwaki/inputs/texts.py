"""JSON and TOML from a person's files, as plain values."""

from __future__ import annotations

import json
import re
import tomllib
from os import PathLike
from typing import Any

from niwaki.inputs.guard import library
from niwaki.inputs.limits import check

#: Digits of a whole number that is kept exact: those of 64 bits.
DIGITS = 19


def json_of(text: str, place: str | PathLike[str] | None, what: str = "JSON") -> Any:
    """The value of a JSON text; whole numbers beyond 64 bits become real ones.

    Raises
    ------
    FileError
        It is no JSON, nested too deeply, or holds more than is read.
    """
    check("tokens", sum(text.count(sign) for sign in ",[{"), place)
    with library(place, what):
        return json.loads(text, parse_int=_whole)


def toml_of(text: str, place: str | PathLike[str] | None, what: str = ".toml") -> dict[str, Any]:
    """The table of a TOML text.

    Raises
    ------
    FileError
        It is no TOML, nested too deeply, or has a key of too many parts.
    """
    # Dots in strings and in numbers are no parts of a key.
    for line in text.splitlines():
        if line.count(".") > 2:
            check("dots", re.sub(r'"(?:[^"\\]|\\.)*"|\'[^\']*\'|\d\.\d', "", line).count("."), place)
    with library(place, what):
        return tomllib.loads(text)


def _whole(digits: str) -> int | float:
    return int(digits) if len(digits) <= DIGITS else float(digits)
