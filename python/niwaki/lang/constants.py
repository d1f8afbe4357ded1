"""Python objects that may cross to the engine as data."""

from __future__ import annotations

from typing import Any

import numpy as np

from niwaki._engine import Shape
from niwaki.lang.core import is_literal
from niwaki.words.vectors import Rotation, Vec

NUMERIC = "biuf"


def plain(value: Any) -> Any:
    """Return a scalar of NumPy as a scalar of Python; any other value as it is."""
    if isinstance(value, np.generic):
        return value.item()
    return value


def is_data(value: Any) -> bool:
    """Return whether a value is plain data: numbers, strings, tuples, lists, dicts, arrays, vectors, shapes."""
    if isinstance(value, np.ndarray):
        return value.dtype.kind in NUMERIC
    if isinstance(value, (Vec, Rotation, Shape)):
        return True
    if type(value) in (list, tuple):
        return all(map(is_data, value))
    if type(value) is dict:
        return all(map(is_literal, value)) and all(map(is_data, value.values()))
    if isinstance(value, np.generic):
        return value.dtype.kind in NUMERIC
    if type(value) is int:
        return -(2**63) <= value < 2**63
    return is_literal(value)
