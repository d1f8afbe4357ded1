"""Functions of numbers that Python's `math` does not have."""

from __future__ import annotations

__all__ = ["clip", "lerp", "linspace", "sign", "smoothstep"]


def clip(x: float, lo: float, hi: float) -> float:
    """Return `x`, moved to the nearer of `lo` and `hi` if it is outside of them."""
    return lo if x < lo else hi if x > hi else x


def lerp(a: float, b: float, t: float) -> float:
    """Interpolate linearly from `a` (t = 0) to `b` (t = 1): `a + (b - a) * t`, also for vectors."""
    return a + (b - a) * t


def sign(x: float) -> int:
    """Return 1, 0 or -1 if `x` is positive, zero or negative."""
    return (x > 0) - (x < 0)


def linspace(lo: float, hi: float, count: int) -> list[float]:
    """Return `count` numbers from `lo` to `hi`, at equal distances, with both ends; only `lo` if `count` is 1."""
    if count < 1:
        raise ValueError(f"`linspace` gives 1 number or more, not {count}")
    last = count - 1
    between = [lo + (hi - lo) * (k / last) for k in range(1, last)]
    return [float(lo), *between, float(hi)] if last else [float(lo)]


def smoothstep(x: float, lo: float = 0.0, hi: float = 1.0) -> float:
    """Return 0 up to `lo`, 1 from `hi` on, and a smooth step between them (the cubic `3 t² - 2 t³`)."""
    if hi == lo:
        raise ZeroDivisionError("`smoothstep`: `lo` and `hi` are equal")
    t = (x - lo) / (hi - lo)
    t = 0.0 if t < 0.0 else 1.0 if t > 1.0 else t
    return t * t * (3.0 - 2.0 * t)
