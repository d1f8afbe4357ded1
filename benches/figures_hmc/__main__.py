"""The figures and the tables of dissertation chapter 4, drawn again.

    make figures-hmc                              # or: .venv/bin/python benches/figures_hmc [FOLDER] [PART ...]
    QUICK=1 make figures-hmc                      # a smoke run: few draws
    make figures-hmc PARTS="structures"           # some of the parts

Parts, in order: `point` (figures 4.2 and 4.3); `structures` (figures 4.8, 4.9, 4.11 to 4.13 and the table of 4.10).
Each leaves pictures and one line of JSON for each measurement in FOLDER, out/figures-hmc unless named.
"""

import json
import os
import sys
import time
from pathlib import Path

import point
import structures

PARTS = {"point": point.draw, "structures": structures.draw}


def main(folder: Path, parts: list[str]) -> None:
    """Make the parts that are named, all without a name, and say how long each took."""
    quick = bool(os.environ.get("QUICK"))
    folder.mkdir(parents=True, exist_ok=True)
    for name in parts or list(PARTS):
        start = time.perf_counter()
        with (folder / f"{name}.jsonl").open("w") as lines:

            def tell(row: dict, lines=lines) -> None:
                lines.write(json.dumps(row) + "\n")
                lines.flush()

            PARTS[name](folder, tell, quick)
        print(f"{name}: {time.perf_counter() - start:.0f} s, in {folder}", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/figures-hmc"), sys.argv[2:])
