"""Soft constraints: what should hold, within a stated width, as log scores for `factor`; and smooth bends.

Each function has derivatives of every order in all of its arguments. A width has the units of what is compared; it
must be above 0. The one-sided scores and the smooth minimum, maximum and absolute value are all made of
`sqrt(d^2 + width^2)`, which is `|d|` far from 0 and bends within a width of it.
"""

from __future__ import annotations

import math

from niwaki.words.running import current

__all__ = ["smooth_abs", "smooth_max", "smooth_min", "soft_at_least", "soft_at_most", "softeq"]

HALF_LOG_TAU = 0.918_938_533_204_672_8


def softeq(a: float, b: float, width: float) -> float:
    """The log score for `a` being equal to `b`: the log of a normal density (dissertation eq. 4.1), nats.

    Parameters
    ----------
    a, b
        What should be equal.
    width
        The standard deviation of `a - b`; above 0.

    Returns
    -------
    float
        `-((a - b) / width)^2 / 2 - log(width) - log(2 pi) / 2`: give it to `factor`.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("softeq", width)
    _note("softeq", a, b, width)
    z = (a - b) / width
    return -0.5 * z * z - math.log(width) - HALF_LOG_TAU


def soft_at_least(a: float, b: float, width: float) -> float:
    """The log score for `a` being `b` or more: flat where it is, falling like a normal density where it is not, nats.

    Parameters
    ----------
    a
        What should be large.
    b
        How large at least.
    width
        How far below `b` costs as much as one standard deviation; above 0.

    Returns
    -------
    float
        `-e^2 / 2` with the smooth shortfall `e = (d + sqrt(d^2 + 1)) / 2`, `d = (b - a) / width`: about 0 far above,
        -1/8 at it, `-d^2 / 2` well below. Give it to `factor`.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("soft_at_least", width)
    _note("soft_at_least", a, b, width)
    return _shortfall((b - a) / width)


def soft_at_most(a: float, b: float, width: float) -> float:
    """The log score for `a` being `b` or less: `soft_at_least` turned around, nats.

    Parameters
    ----------
    a
        What should be small.
    b
        How large at most.
    width
        How far above `b` costs as much as one standard deviation; above 0.

    Returns
    -------
    float
        `-e^2 / 2` with the smooth excess `e = (d + sqrt(d^2 + 1)) / 2`, `d = (a - b) / width`. Give it to `factor`.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("soft_at_most", width)
    _note("soft_at_most", a, b, width)
    return _shortfall((a - b) / width)


def smooth_max(a: float, b: float, width: float) -> float:
    """The larger of two, without a corner: above it by `width / 2` where they are equal, by less elsewhere.

    Parameters
    ----------
    a, b
        Two numbers.
    width
        How far apart they are where the bend ends; above 0.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("smooth_max", width)
    return 0.5 * (a + b + math.sqrt((a - b) * (a - b) + width * width))


def smooth_min(a: float, b: float, width: float) -> float:
    """The smaller of two, without a corner: below it by `width / 2` where they are equal, by less elsewhere.

    Parameters
    ----------
    a, b
        Two numbers.
    width
        How far apart they are where the bend ends; above 0.
    """
    a, b, width = 1.0 * a, 1.0 * b, _checked("smooth_min", width)
    return 0.5 * (a + b - math.sqrt((a - b) * (a - b) + width * width))


def smooth_abs(x: float, width: float) -> float:
    """The distance from 0, without a corner: above it by `width` at 0, by less elsewhere.

    Parameters
    ----------
    x
        A number.
    width
        How far from 0 the bend ends; above 0.
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
    """Tell a plain run that keeps residuals."""
    run = current.get()
    if run is not None:
        run.constraint(kind, a, b, width)
