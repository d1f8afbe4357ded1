"""Checks that all numbers of a file are finite.

Every writer checks its coordinates here. Files have numbers of 32 bits, and a scale multiplies, so coordinates that are
finite in a scene may overflow in a file.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki.errors import FileError


def finite(values: ArrayLike, part: str, quantity: str = "its coordinates") -> NDArray[np.float64]:
    """Return the numbers if all are finite.

    Parameters
    ----------
    values
        Numbers, of any shape.
    part
        The owner of the numbers, for the message; usually an address.
    quantity
        The name of the numbers, for the message.

    Raises
    ------
    FileError
        `not-finite`: a number is nan or infinite.
    """
    numbers = np.asarray(values, dtype=np.float64)
    bad = numbers[~np.isfinite(numbers)]
    if bad.size:
        raise FileError(
            "not-finite",
            part=part,
            what=quantity,
            count=f"{bad.size} of {numbers.size}",
            found=f"{bad.flat[0]}",
        )
    return numbers


def floats(values: ArrayLike, part: str, quantity: str = "its coordinates") -> NDArray[np.float32]:
    """Convert the numbers to 32 bits, as in files, and check them with `finite`."""
    with np.errstate(over="ignore", invalid="ignore"):
        numbers = np.asarray(values, dtype="<f4")
    finite(numbers, part, quantity)
    return numbers


def scalar(value: float | None) -> float | None:
    """Return a number for a table or JSON; None if it is not finite."""
    return value if value is not None and math.isfinite(value) else None


def plain(value: Any) -> Any:
    """Convert a choice to JSON; reals that are not finite become text."""
    if isinstance(value, tuple):
        return [plain(part) for part in value]
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    return value


def json_text(data: Any, owner: str, **layout: Any) -> str:
    """Write data as JSON.

    Raises
    ------
    FileError
        `not-finite`: JSON cannot represent such numbers.
    """
    try:
        return json.dumps(data, allow_nan=False, **layout)
    except ValueError as error:
        raise FileError(
            "not-finite", part=owner, what="its values", count="some", found=str(error)
        ) from error
