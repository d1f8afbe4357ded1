"""JSON, TOML and plain numbers from a person's files, as plain values."""

from __future__ import annotations

import codecs
import json
import re
import tomllib
import warnings
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

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


def numbers_of(text: bytes, kind: type[np.generic]) -> NDArray[Any] | None:
    """The numbers of a text with blanks between them; nothing where there is anything else."""
    with warnings.catch_warnings():
        # NumPy warns where it stops in the middle.
        warnings.simplefilter("error")
        try:
            return np.fromstring(text, kind, sep=" ") if text.strip() else np.empty(0, kind)
        except (ValueError, DeprecationWarning):
            return None


def lines_of(data: bytes) -> bytes:
    r"""A text whose lines all end in ``\n``, without a mark of its byte order."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        data = data.decode("utf-16", "replace").encode()
    return data.removeprefix(codecs.BOM_UTF8).replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def _whole(digits: str) -> int | float:
    return int(digits) if len(digits) <= DIGITS else float(digits)
