"""Changed run files and searches in JSON: each is replayed, or gives a message.

    python tests/fuzz/run_files.py [SECONDS] [SEED]

The files and the changes are those of `tests/niwaki/shell`.
"""

from __future__ import annotations

import random
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / part) for part in ("fuzz", "niwaki/shell")]

from mutated import mutated  # noqa: E402
from reports import Report, report  # noqa: E402
from test_run_files import files, read_search, replay, searches_as_json, tracebacks  # noqa: E402

#: Changes of one file before the next one.
ROUND = 20


def fuzz(seconds: float, seed: int, to: Report) -> None:
    """Files of both kinds in turn."""
    chance, end = random.Random(seed), time.monotonic() + seconds
    whole: list[tuple[object, Callable[[Path], object]]] = [(data, replay) for data in files().values()]
    whole += [(data, read_search) for data in searches_as_json().values()]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "run.json"
        while time.monotonic() < end:
            data, reader = chance.choice(whole)
            for _ in range(ROUND):
                change, text = mutated(data, chance)
                for wrong in tracebacks([(change, text)], reader, place):
                    to.finding(text, ".json", wrong)
                to.tried(reader.__name__)


if __name__ == "__main__":
    report("run_files", fuzz)
