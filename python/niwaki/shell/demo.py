"""Growth of the gallery into its targets, with pictures and files.

    python -m niwaki.shell.demo OUT

Each entry with a target is grown by its command, which is printed, so that you can try it with other settings.
OUT/NAME gets best.glb, best.png, sheet.png (all results side by side) and run.json.
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
    """Grow every entry that has a target into a folder of its name.

    Parameters
    ----------
    folder
        The parent folder; it is created if it is missing.
    """
    start = time.perf_counter()
    for entry in entries():
        if entry.target_name is None:
            continue
        place = folder / entry.name
        print(f"\n{entry.name}: {entry.title}, into the target `{entry.target_name}`")
        command = f"grow {entry.name} --runs {RUNS} --seed {SEED} --effort 0.1 --force -o".split() + [
            str(place)
        ]
        print("$ niwaki", *command, flush=True)
        entry_start = time.perf_counter()
        app(command, standalone_mode=False)
        seconds = time.perf_counter() - entry_start
        searching = sum(run["seconds"] for run in json.loads((place / "run.json").read_text())["runs"])
        print(f"{searching:.1f} s of inference, {seconds - searching:.1f} s of compiling, pictures and files")
    print(f"\n{time.perf_counter() - start:.1f} s in total; see {folder}/*/sheet.png")


if __name__ == "__main__":
    demo(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
