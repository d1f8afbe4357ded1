"""Random programs without an end: plain Python and the engine agree, and the four strategies of a chain do.

    python tests/fuzz/agreement.py [SECONDS] [SEED]

The programs and the comparisons are those of `tests/agreement`, from fresh seeds. A program that differs is shrunk.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / part) for part in ("fuzz", "agreement")]

import chain_programs  # noqa: E402
import programs  # noqa: E402
from reports import Report, report  # noqa: E402
from test_chains import disagreement  # noqa: E402
from test_engine import differs  # noqa: E402

#: Proposals of each program.
STEPS = 60


def fuzz(seconds: float, seed: int, to: Report) -> None:
    """Programs of both kinds in turn."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        whole = programs.program(seed)
        if differs(whole.text):
            small = programs.shrink(whole, lambda text: bool(differs(text)))
            to.finding(small.text, ".py", differs(small.text))
        to.tried("in plain Python and the engine")
        whole = chain_programs.program(seed)
        if disagreement(whole.text, seed, STEPS):
            small = programs.shrink(whole, lambda text: bool(disagreement(text, seed, STEPS)))  # noqa: B023
            to.finding(small.text, ".py", f"seed {seed}\n{disagreement(small.text, seed, STEPS)}")
        to.tried("by four strategies")
        seed += 1


if __name__ == "__main__":
    report("agreement", fuzz)
