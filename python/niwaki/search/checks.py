"""Checks before a search starts: seeds, threads, values of choices, and the method that polishes."""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from typing import Any

from niwaki.errors.settings import THREADS, bad, is_whole
from niwaki.methods import Mh


def check_seed(seed: int) -> int:
    """Check a seed."""
    if not isinstance(seed, int) or isinstance(seed, bool) or not 0 <= seed < 2**64:
        raise bad("seed", seed, "a whole number from 0 to 2**64 - 1", "such a number, or leave it out")
    return seed


def check_values(name: str, values: Any) -> None:
    """Check that a setting is None, or values by address."""
    has_addresses = isinstance(values, Mapping) and all(isinstance(address, str) for address in values)
    if values is not None and not has_addresses:
        raise bad(name, values, "values of choices by address", '`{"width": 2.0}`, or `result.best.choices`')


def check_polish(method: Any) -> None:
    """Refuse a method that is not Metropolis-Hastings."""
    if not isinstance(method, Mh):
        suggestion = "`mh(20_000)`, or with a kernel `mh(20_000, kernel=kernels.drift())`"
        raise bad("polish", method, "Metropolis-Hastings", suggestion)


def check_threads(threads: int | None) -> int | None:
    """Check a number of threads."""
    if threads is not None and (not is_whole(threads) or not 1 <= threads <= THREADS):
        raise bad(
            "threads",
            threads,
            f"a whole number from 1 to {THREADS}",
            "such a number, or leave it out for all cores",
        )
    return threads


def fresh(seed: int | None) -> int:
    """Check a seed; without one, draw a fresh seed."""
    return secrets.randbits(32) if seed is None else check_seed(seed)
