"""Functions of numbers that Python's `math` does not have."""

from __future__ import annotations

__all__ = ["clip", "lerp", "sign"]


def clip(x: float, lo: float, hi: float) -> float:
    """Return `x`, moved to the nearer of `lo` and `hi` if it is outside of them."""
    return lo if x < lo else hi if x > hi else x


def lerp(a: float, b: float, t: float) -> float:
    """Interpolate linearly from `a` (t = 0) to `b` (t = 1): `a + (b - a) * t`, also for vectors."""
    return a + (b - a) * t


def sign(x: float) -> int:
    """Return 1, 0 or -1 if `x` is positive, zero or negative."""
    return (x > 0) - (x < 0)
