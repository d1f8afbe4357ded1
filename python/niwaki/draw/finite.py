"""No number leaves in a file that is not finite.

Every writer passes its coordinates through here. Files keep numbers of 32 bits, and a scale multiplies, so that
coordinates which are finite in a scene need not be so in a file.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki.errors import FileError


def finite(values: ArrayLike, part: str, what: str = "its coordinates") -> NDArray[np.float64]:
    """The numbers, all finite.

    Parameters
    ----------
    values
        Any number of dimensions.
    part
        Whose they are, for the message: an address, mostly.
    what
        What they are.

    Raises
    ------
    FileError
        `not-finite`: one of them is nan or infinite.
    """
    numbers = np.asarray(values, dtype=np.float64)
    bad = numbers[~np.isfinite(numbers)]
    if bad.size:
        raise FileError(
            "not-finite", part=part, what=what, count=f"{bad.size} of {numbers.size}", found=f"{bad.flat[0]}"
        )
    return numbers


def floats(values: ArrayLike, part: str, what: str = "its coordinates") -> NDArray[np.float32]:
    """The numbers as the 32 bits that files keep, all finite; errors as of `finite`."""
    with np.errstate(over="ignore", invalid="ignore"):
        numbers = np.asarray(values, dtype="<f4")
    finite(numbers, part, what)
    return numbers


def scalar(value: float | None) -> float | None:
    """A number for a table or JSON; None where it is not finite."""
    return value if value is not None and math.isfinite(value) else None


def plain(value: Any) -> Any:
    """A choice as JSON; reals that are not finite as text."""
    if isinstance(value, tuple):
        return [plain(part) for part in value]
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    return value


def json_text(data: Any, what: str, **layout: Any) -> str:
    """Data as JSON.

    Raises
    ------
    FileError
        `not-finite`: JSON has no words for such numbers.
    """
    try:
        return json.dumps(data, allow_nan=False, **layout)
    except ValueError as error:
        raise FileError("not-finite", part=what, what="its values", count="some", found=str(error)) from error
