"""The report of a fuzzer in Python: inputs by what became of them, and findings, each with its input in a file."""

from __future__ import annotations

import hashlib
import json
import secrets
import sys
from collections import Counter
from collections.abc import Callable
from pathlib import Path

#: Where the inputs of findings go.
FINDINGS = Path(__file__).resolve().parents[2] / "out" / "fuzz"


class Report:
    """Counts of one fuzzer."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.counts: Counter[str] = Counter()
        self.found: list[str] = []

    def tried(self, became: str) -> None:
        """Counts an input."""
        self.counts[became] += 1

    def finding(self, text: str | bytes, suffix: str, wrong: str) -> None:
        """Keeps an input, with what is wrong beside it."""
        content = text.encode(errors="surrogateescape") if isinstance(text, str) else text
        FINDINGS.mkdir(parents=True, exist_ok=True)
        path = FINDINGS / f"{self.name}-{hashlib.sha256(content).hexdigest()[:12]}{suffix}"
        path.write_bytes(content)
        path.with_name(path.name + ".txt").write_text(wrong)
        self.found.append(f"{path}: {wrong.strip().splitlines()[-1][:200] if wrong.strip() else ''}")
        print(self.found[-1], flush=True)


def report(name: str, fuzz: Callable[[float, int, Report], None]) -> None:
    """Runs a fuzzer for the seconds and with the seed of the command line; the last line is JSON."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else secrets.randbelow(2**31)
    print(f"{name}: {seconds:.0f} s from seed {seed}", flush=True)
    report_of_name = Report(name)
    fuzz(seconds, seed, report_of_name)
    print(
        json.dumps(
            {
                "inputs": report_of_name.counts.total(),
                "counts": dict(report_of_name.counts),
                "findings": report_of_name.found,
            }
        )
    )
    sys.exit(1 if report_of_name.found else 0)
