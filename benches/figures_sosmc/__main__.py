"""The figures and the table of dissertation chapter 5, drawn again, and what they cost.

    make figures-sosmc                                      # or: .venv/bin/python benches/figures_sosmc [FOLDER]
    NIWAKI_REFERENCE_TARGETS=folder make figures-sosmc      # figure 5.9 on the original's meshes as well
    QUICK=1 make figures-sosmc                              # a smoke run: small populations, one run of each
    make figures-sosmc PARTS="examples growth"              # some of the parts

Parts, in order: `examples` (figures 5.1 to 5.8 and table 5.1), `comparison` (figure 5.9), `growth` (what a primitive
costs), `threads` (what a second thread saves). Each leaves pictures and one line of JSON for each measurement in
FOLDER, out/figures-sosmc unless named.
"""

import json
import os
import sys
import time
from pathlib import Path

import comparison
import examples
import growth
import threads

PARTS = {
    "examples": examples.draw,
    "comparison": comparison.draw,
    "growth": growth.draw,
    "threads": threads.draw,
}


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
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/figures-sosmc"), sys.argv[2:])
