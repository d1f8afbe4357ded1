"""Draws and densities in a plain-Python run: the engine's own, so that both runs have the same numbers."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable
from typing import Any

from niwaki import _engine
from niwaki.words.distributions import Distribution


def grid(log_score: float) -> float:
    """Give the nearest multiple of 2^-32 nats, as the engine does (crates/math/src/rounding.rs)."""
    return round(log_score * 2.0**32) * 2.0**-32 if abs(log_score) < 2.0**20 else log_score


def total(terms: Iterable[float]) -> float:
    """Give the exact sum of log scores, rounded once, as the engine does (crates/math/src/total.rs)."""
    # Scaled, so that no partial sum overflows; multiples of 2^-32 lose nothing.
    return math.fsum(term * 2.0**-64 for term in terms) * 2.0**64


def hashed(address: str) -> int:
    """A 128-bit number for a readable address."""
    return int.from_bytes(hashlib.blake2b(address.encode(), digest_size=16).digest(), "little")


def parameters(dist: Distribution) -> list[Any]:
    """The parameters as the engine takes them: distributions as (family, parameters)."""
    return [_parameter(part) for part in dist.parameters]


def _parameter(value: Any) -> Any:
    if isinstance(value, Distribution):
        return (value.family, parameters(value))
    if isinstance(value, (list, tuple)):
        return [_parameter(part) for part in value]
    return value.tolist() if hasattr(value, "tolist") else value


def log_density(dist: Distribution, value: Any) -> float:
    """The log density of a value (nats), on the grid."""
    return grid(float(_engine.log_density(dist.family, parameters(dist), value)))


def is_valid(dist: Distribution) -> bool:
    """Whether the parameters are in their ranges and of their kinds."""
    try:
        _engine.support(dist.family, parameters(dist))
    except (ValueError, TypeError):
        return False
    return True


def draw(dist: Distribution, seed: int, address: str) -> Any:
    """The value that a seed gives at an address."""
    value = _engine.draw_at(dist.family, parameters(dist), seed, 0, hashed(address), 0)
    return tuple(value) if isinstance(value, list) else value
