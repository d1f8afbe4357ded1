"""Draws and densities for runs in plain Python, computed by the engine so that all runs have the same numbers."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable
from typing import Any

from niwaki import _engine
from niwaki.words.distributions import Distribution


def grid(log_score: float) -> float:
    """Return the nearest multiple of 2^-32 nats, as the engine does (crates/math/src/rounding.rs)."""
    return round(log_score * 2.0**32) * 2.0**-32 if abs(log_score) < 2.0**20 else log_score


def total(terms: Iterable[float]) -> float:
    """Return the exact sum of log scores, rounded once, as the engine does (crates/math/src/total.rs)."""
    # Scaled, so that no partial sum overflows; multiples of 2^-32 lose nothing.
    return math.fsum(term * 2.0**-64 for term in terms) * 2.0**64


def hashed(address: str) -> int:
    """Return a 128-bit hash of a readable address."""
    return int.from_bytes(hashlib.blake2b(address.encode(), digest_size=16).digest(), "little")


def parameters(dist: Distribution) -> list[Any]:
    """Return the parameters for the engine; a distribution becomes (family, parameters)."""
    return [_parameter(part) for part in dist.parameters]


def _parameter(value: Any) -> Any:
    if isinstance(value, Distribution):
        return (value.family, parameters(value))
    if isinstance(value, (list, tuple)):
        return [_parameter(part) for part in value]
    return value.tolist() if hasattr(value, "tolist") else value


def log_density(dist: Distribution, value: Any) -> float:
    """Return the log density of a value in nats, rounded to the grid."""
    return grid(float(_engine.log_density(dist.family, parameters(dist), value)))


def is_valid(dist: Distribution) -> bool:
    """Return whether the parameters have the right types and are in their ranges."""
    try:
        _engine.support(dist.family, parameters(dist))
    except (ValueError, TypeError):
        return False
    return True


def draw(dist: Distribution, seed: int, address: str) -> Any:
    """Return the value that a seed draws at an address."""
    value = _engine.draw_at(dist.family, parameters(dist), seed, 0, hashed(address), 0)
    return tuple(value) if isinstance(value, list) else value
