"""Damaged files of every format that is read: each is read or refused, in time and memory.

    python tests/fuzz/readers.py [SECONDS] [SEED]

The files and the damages are those of `tests/niwaki/inputs`. The seed is the number of the first input.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / part) for part in ("fuzz", "niwaki/inputs", "niwaki/targets")]

from reports import Report, report  # noqa: E402
from test_mutations import APART, KINDS, attempt  # noqa: E402


def fuzz(seconds: float, seed: int, to: Report) -> None:
    """Every kind in turn; those that start a process of their own every twentieth time."""
    end, number = time.monotonic() + seconds, seed
    with tempfile.TemporaryDirectory() as folder:
        while time.monotonic() < end:
            for kind in KINDS:
                if kind in APART and number % 20:
                    continue
                try:
                    to.tried("refused" if attempt(kind, number, Path(folder)) else "read")
                except AssertionError as error:
                    to.tried("broken")
                    to.finding(f"{kind} {number}", ".txt", str(error))
            number += 1


if __name__ == "__main__":
    report("readers", fuzz)
