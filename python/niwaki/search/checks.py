"""Checks before a search starts: seeds, threads, values of choices, and the method that polishes."""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from typing import Any

from niwaki.errors.settings import THREADS, bad, is_whole
from niwaki.methods import Improve, Mh


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


def check_polish(method: Any, may_improve: bool = False) -> None:
    """Refuse a method that is not Metropolis-Hastings, or `improve` for one result where that is allowed."""
    is_improve = isinstance(method, Improve) and method.diverse is None
    if not isinstance(method, Mh) and not (may_improve and is_improve):
        suggestion = "`mh(20_000)`, or with a kernel `mh(20_000, kernel=kernels.drift())`"
        expected = "Metropolis-Hastings" + (", or `improve` for one result" if may_improve else "")
        raise bad("polish", method, expected, suggestion)


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
