"""Populations in lanes say what particles that run one by one say, to the bit, on random programs.

The programs are those of `programs`, with observations and factors in a loop around them so that a population has
barriers. A search runs in two processes, of which one has `NIWAKI_LANES=0`; what they print must be equal. Seeds are
fixed. Nothing here is statistical.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SEARCHES = Path(__file__).with_name("searches.py")


def hashes(first: int, count: int, kind: str = "populations", **switches: str) -> dict[str, str]:
    """Return the output of each search, by the seed of its program, with variables of the environment."""
    # Names of files are hashes of texts, which messages repeat.
    settings = dict(os.environ, PYTHONHASHSEED="0", **switches)
    command = [sys.executable, str(SEARCHES), str(first), str(count), kind]
    done = subprocess.run(command, env=settings, capture_output=True, text=True, check=True)
    answers: dict[str, str] = json.loads(done.stdout)
    return answers


def compare(first: dict[str, str], second: dict[str, str], count: int) -> None:
    """Hold what so many searches print against each other."""
    assert len(first) == count
    different = [seed for seed in first if first[seed] != second[seed]]
    assert not different, (different[0], first[different[0]], second[different[0]])


def agree(first: int, count: int) -> None:
    """Compare the searches of so many programs."""
    compare(hashes(first, count, NIWAKI_LANES="1"), hashes(first, count, NIWAKI_LANES="0"), count)


def test_lanes_agree_on_random_programs() -> None:
    """Sixty programs."""
    agree(7_000_000, 60)


@pytest.mark.soak
def test_lanes_agree_on_many_random_programs() -> None:
    """Fresh ones, for two minutes."""
    first = int.from_bytes(os.urandom(4), "big")
    print(f"first seed {first}")
    agree(first, 2000)
