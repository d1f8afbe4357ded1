"""Figures in parts: those that are named are drawn into a folder, each with its lines of JSON."""

import json
import os
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path

#: Draws a part into a folder and reports each measurement; the last argument selects a smoke run.
Part = Callable[[Path, Callable[[dict], None], bool], None]


def main(parts: Mapping[str, Part], default: str) -> None:
    """Make the parts that the command line names, all without a name, and say how long each took.

    Parameters
    ----------
    parts
        What can be drawn, by name, in order.
    default
        The folder, where the command line names none.
    """
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else default)
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or list(parts):
        start = time.perf_counter()
        with (folder / f"{name}.jsonl").open("w") as lines:

            def tell(row: dict, lines=lines) -> None:
                lines.write(json.dumps(row) + "\n")
                lines.flush()

            parts[name](folder, tell, bool(os.environ.get("QUICK")))
        print(f"{name}: {time.perf_counter() - start:.0f} s, in {folder}", flush=True)
