"""Grow the gallery into its targets and leave pictures and files behind.

    python -m niwaki.shell.demo OUT

Each entry with a target is grown as the shell would grow it; its command is printed, so that it can be tried with other
settings. OUT/NAME gets best.glb, best.png, sheet.png (all results beside each other) and run.json.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

from niwaki.gallery import entries
from niwaki.shell.main import app

RUNS = 6
SEED = 1


def demo(folder: Path) -> None:
    """Grow every entry that has a target; files go to folders in `folder`.

    Parameters
    ----------
    folder
        Made where it is missing.
    """
    start = time.perf_counter()
    for entry in entries():
        if entry.target_name is None:
            continue
        place = folder / entry.name
        print(f"\n{entry.name}: {entry.title}, into the target `{entry.target_name}`")
        words = f"grow {entry.name} --runs {RUNS} --seed {SEED} --force -o".split() + [str(place)]
        print("$ niwaki", *words, flush=True)
        began = time.perf_counter()
        app(words, standalone_mode=False)
        seconds = time.perf_counter() - began
        searching = sum(run["seconds"] for run in json.loads((place / "run.json").read_text())["runs"])
        print(f"{searching:.1f} s of inference, {seconds - searching:.1f} s of compiling, pictures and files")
    print(f"\n{time.perf_counter() - start:.1f} s in all; look at {folder}/*/sheet.png")


if __name__ == "__main__":
    demo(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
