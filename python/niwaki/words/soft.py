"""Soft constraints, as log scores for `factor`, and smooth versions of the minimum, maximum and absolute value.

Each function has derivatives of every order in all of its arguments. A width is a tolerance in the units of the
compared numbers, above 0. The one-sided scores and the smooth functions use `sqrt(d^2 + width^2)`, which is `|d|` far
from 0 and bends within a width of 0.
"""

from __future__ import annotations

import math

from niwaki.words.running import current

__all__ = ["smooth_abs", "smooth_max", "smooth_min", "soft_at_least", "soft_at_most", "softeq"]

HALF_LOG_TAU = 0.918_938_533_204_672_8


def softeq(a: float, b: float, width: float) -> float:
    """Return the log score, in nats, for `a` being equal to `b`: a normal log density (dissertation eq. 4.1).

    Parameters
    ----------
    a, b
        The numbers that should be equal.
    width
        The standard deviation of `a - b`; above 0.

    Returns
    -------
    float
        `-((a - b) / width)^2 / 2 - log(width) - log(2 pi) / 2`, for `factor`.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("softeq", width)
    _note("softeq", a, b, width)
    z = (a - b) / width
    return -0.5 * z * z - math.log(width) - HALF_LOG_TAU


def soft_at_least(a: float, b: float, width: float) -> float:
    """Return the log score, in nats, for `a` being `b` or more: flat above `b`, falling like a normal density below.

    Parameters
    ----------
    a
        The number that should be large.
    b
        The least value that it should have.
    width
        The distance below `b` that counts as one standard deviation; above 0.

    Returns
    -------
    float
        `-e^2 / 2` with the smooth shortfall `e = (d + sqrt(d^2 + 1)) / 2`, `d = (b - a) / width`: about 0 far above,
        -1/8 at `b`, `-d^2 / 2` far below, for `factor`.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("soft_at_least", width)
    _note("soft_at_least", a, b, width)
    return _shortfall((b - a) / width)


def soft_at_most(a: float, b: float, width: float) -> float:
    """Return the log score, in nats, for `a` being `b` or less: the mirror image of `soft_at_least`.

    Parameters
    ----------
    a
        The number that should be small.
    b
        The greatest value that it should have.
    width
        The distance above `b` that counts as one standard deviation; above 0.

    Returns
    -------
    float
        `-e^2 / 2` with the smooth excess `e = (d + sqrt(d^2 + 1)) / 2`, `d = (a - b) / width`, for `factor`.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("soft_at_most", width)
    _note("soft_at_most", a, b, width)
    return _shortfall((a - b) / width)


def smooth_max(a: float, b: float, width: float) -> float:
    """Return a smooth maximum, at most `width / 2` above the larger number, where both are equal.

    Parameters
    ----------
    a, b
        Two numbers.
    width
        The difference of the numbers at which the bend ends; above 0.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("smooth_max", width)
    return 0.5 * (a + b + math.sqrt((a - b) * (a - b) + width * width))


def smooth_min(a: float, b: float, width: float) -> float:
    """Return a smooth minimum, at most `width / 2` below the smaller number, where both are equal.

    Parameters
    ----------
    a, b
        Two numbers.
    width
        The difference of the numbers at which the bend ends; above 0.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("smooth_min", width)
    return 0.5 * (a + b - math.sqrt((a - b) * (a - b) + width * width))


def smooth_abs(x: float, width: float) -> float:
    """Return a smooth absolute value, at most `width` above `|x|`, at 0.

    Parameters
    ----------
    x
        A number.
    width
        The distance from 0 at which the bend ends; above 0.
    """
    x, width = 1.0 * x, _checked("smooth_abs", width)
    return math.sqrt(x * x + width * width)


def _shortfall(d: float) -> float:
    e = 0.5 * (d + math.sqrt(d * d + 1.0))
    return -0.5 * e * e


def _checked(word: str, width: float) -> float:
    width = 1.0 * width
    if not 0.0 < width < math.inf:
        raise ValueError(f"the width of `{word}` is {width}: it must be above 0")
    return width


def _note(kind: str, a: float, b: float, width: float) -> None:
    """Report the constraint to a plain run, which records residuals."""
    run = current.get()
    if run is not None:
        run.constraint(kind, a, b, width)
