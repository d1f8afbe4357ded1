"""JSON, TOML and numbers from users' files, as plain values."""

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

#: The most digits of a whole number that stays exact: those of 64 bits.
DIGITS = 19


def json_of(text: str, place: str | PathLike[str] | None, kind: str = "JSON") -> Any:
    """Return the value of a JSON text; whole numbers beyond 64 bits become real numbers.

    Raises
    ------
    FileError
        The text is not JSON, is nested too deeply, or exceeds a limit.
    """
    check("tokens", sum(text.count(sign) for sign in ",[{"), place)
    with library(place, kind):
        return json.loads(text, parse_int=_whole)


def toml_of(text: str, place: str | PathLike[str] | None, kind: str = ".toml") -> dict[str, Any]:
    """Return the table of a TOML text.

    Raises
    ------
    FileError
        The text is not TOML, is nested too deeply, or has a key of too many parts.
    """
    # Dots in strings and numbers do not belong to keys.
    for line in text.splitlines():
        if line.count(".") > 2:
            check("dots", re.sub(r'"(?:[^"\\]|\\.)*"|\'[^\']*\'|\d\.\d', "", line).count("."), place)
    with library(place, kind):
        return tomllib.loads(text)


def numbers_of(text: bytes, kind: type[np.generic]) -> NDArray[Any] | None:
    """Return the numbers of a text, separated by blanks; None if the text has anything else."""
    with warnings.catch_warnings():
        # NumPy only warns if it stops before the end.
        warnings.simplefilter("error")
        try:
            return np.fromstring(text, kind, sep=" ") if text.strip() else np.empty(0, kind)
        except (ValueError, DeprecationWarning):
            return None


def lines_of(data: bytes) -> bytes:
    r"""Return a text with ``\n`` at the ends of lines, and without a byte order mark."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        data = data.decode("utf-16", "replace").encode()
    return data.removeprefix(codecs.BOM_UTF8).replace(b"\r\n", b"\n").replace(b"\r", b"\n")


def _whole(digits: str) -> int | float:
    return int(digits) if len(digits) <= DIGITS else float(digits)
