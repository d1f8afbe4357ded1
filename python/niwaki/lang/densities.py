"""Draws and densities in a plain-Python run: the engine's own, so that both runs speak of the same numbers."""

from __future__ import annotations

import hashlib
import importlib
from typing import Any

from niwaki.words.distributions import Distribution

#: Adding and taking these away leaves 32 and 12 binary places; the engine does the same (crates/math/src/rounding.rs).
NEAR, FAR = 1.5 * 2.0**20, 1.5 * 2.0**40


def grid(log_score: float) -> float:
    """Give the nearest multiple of 2^-32, or of 2^-12 beyond half a million nats, so that sums have no order."""
    size = abs(log_score)
    if size < 2.0**19:
        return (log_score + NEAR) - NEAR
    return (log_score + FAR) - FAR if size < 2.0**39 else log_score


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
    engine: Any = importlib.import_module("niwaki._engine")
    return grid(float(engine.log_density(dist.family, parameters(dist), value)))


def draw(dist: Distribution, seed: int, address: str) -> Any:
    """The value that a seed gives at an address."""
    engine: Any = importlib.import_module("niwaki._engine")
    value = engine.draw_at(dist.family, parameters(dist), seed, 0, hashed(address), 0)
    return tuple(value) if isinstance(value, list) else value
