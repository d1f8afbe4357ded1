"""Small functions of numbers that Python's `math` lacks."""

from __future__ import annotations

__all__ = ["clip", "lerp", "sign"]


def clip(x: float, lo: float, hi: float) -> float:
    """`x`, or the nearer of `lo` and `hi` when it lies outside of them."""
    return lo if x < lo else hi if x > hi else x


def lerp(a: float, b: float, t: float) -> float:
    """Linear interpolation from `a` (t = 0) to `b` (t = 1): `a + (b - a) * t`; also of vectors."""
    return a + (b - a) * t


def sign(x: float) -> int:
    """1, 0 or -1 as `x` is positive, zero or negative."""
    return (x > 0) - (x < 0)
