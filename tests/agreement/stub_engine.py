"""A stand-in for the engine's draws and densities, for tests of the front end where the engine is not built."""

from __future__ import annotations

import math
import random
import sys
import types
from typing import Any


def log_density(family: str, parameters: list[Any], value: Any) -> float:
    """The log density of a few families; 0 for the others."""
    match family, parameters:
        case "gaussian", [mean, sd]:
            if sd <= 0:
                raise ValueError(f"the standard deviation is {sd}")
            return -0.5 * ((value - mean) / sd) ** 2 - math.log(sd) - 0.5 * math.log(2 * math.pi)
        case "uniform", [lo, hi]:
            return -math.log(hi - lo) if lo <= value <= hi else -math.inf
        case "bernoulli", [p]:
            odds = p if value else 1 - p
            return math.log(odds) if odds > 0 else -math.inf
        case "categorical", [weights]:
            return math.log(weights[value] / sum(weights))
        case "discrete_uniform", [lo, hi]:
            return -math.log(hi - lo + 1) if lo <= value <= hi else -math.inf
    return 0.0


def draw_at(family: str, parameters: list[Any], seed: int, stream: int, address: int, visit: int) -> Any:
    """A draw that depends on seed and address alone."""
    source = random.Random(hash((seed, stream, address, visit)))
    match family, parameters:
        case "gaussian", [mean, sd]:
            return source.gauss(mean, sd)
        case "uniform", [lo, hi]:
            return source.uniform(lo, hi)
        case "bernoulli", [p]:
            return source.random() < p
        case "categorical", [weights]:
            return source.choices(range(len(weights)), weights)[0]
        case "discrete_uniform", [lo, hi]:
            return source.randint(lo, hi)
        case "poisson", [rate]:
            return int(source.expovariate(1 / rate))
    return source.random()


def install() -> None:
    """Put the stand-in where the engine would be, unless the engine is there."""
    try:
        from niwaki import _engine
    except ImportError:
        _engine = None
    if hasattr(_engine, "log_density"):
        return
    import niwaki

    stub = _engine if _engine is not None else types.ModuleType("niwaki._engine")
    stub.log_density, stub.draw_at = log_density, draw_at  # type: ignore[attr-defined]
    sys.modules["niwaki._engine"] = stub
    niwaki._engine = stub  # type: ignore[attr-defined]
