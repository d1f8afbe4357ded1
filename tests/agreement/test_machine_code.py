"""Searches with machine code from the first visit say what they say without any, to the bit, on random programs.

Populations run without lanes, so that their particles are what the code runs. Seeds are fixed; nothing is statistical.
"""

from __future__ import annotations

import os

import pytest
from test_lanes import compare, hashes

KINDS = ["populations", "chains"]


def agree(first: int, count: int, kind: str) -> None:
    """Compare the searches of so many programs."""
    with_code = hashes(first, count, kind, NIWAKI_JIT="1", NIWAKI_LANES="0")
    compare(with_code, hashes(first, count, kind, NIWAKI_JIT="0", NIWAKI_LANES="0"), count)


@pytest.mark.parametrize("kind", KINDS)
def test_machine_code_agrees_on_random_programs(kind: str) -> None:
    agree(8_000_000, 40, kind)


@pytest.mark.soak
@pytest.mark.parametrize("kind", KINDS)
def test_machine_code_agrees_on_many_random_programs(kind: str) -> None:
    first = int.from_bytes(os.urandom(4), "big")
    print(f"first seed {first}")
    agree(first, 2000, kind)
