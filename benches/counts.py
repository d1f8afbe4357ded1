"""Instructions that a unit of work takes, counted by callgrind, beside the committed table: speed without noise.

    make counts                                # or: .venv/bin/python benches/counts.py [--write] [PATH ...]

Each path is a way through the engine that users wait for: a step of a particle, a proposal of a chain, a leapfrog
step, a shape into the sketches, a choice by a guide, a search by `grow`. The example `counts` of the search repeats a
path on one thread; two counts with different repeats give the price of a unit, because starting and
compiling cancel. Machine code of models is off (`NIWAKI_JIT=0`), because a thread of its own writes it; paths called
*compiled* wait for it (`NIWAKI_JIT=1`).

A count that differs from `counts.json` by more than 2 % ends this with 1. A change that
means to change a count writes the table again (`--write`), and its commit says why. Needs Debian's valgrind; without
it nothing is counted.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import niwaki
from niwaki.gallery import entry

ROOT = Path(__file__).resolve().parents[1]
TABLE = ROOT / "benches" / "counts.json"
FOLDER = ROOT / "out" / "counts"
#: A share by which a count may differ: libraries of another release choose other instructions.
ALLOWED = 0.02
#: Paths, the unit of each, and two numbers of repeats.
PATHS = {
    "step hmm": ("particle-step", 1, 3),
    "step branching": ("particle-step", 2, 6),
    "step branching, compiled": ("particle-step", 2, 6),
    "proposal hmm": ("proposal", 1000, 4000),
    "proposal mixture": ("proposal", 1000, 4000),
    "proposal topics": ("proposal", 1000, 4000),
    "proposal regression": ("proposal", 1000, 4000),
    "leapfrog stack": ("leapfrog step", 10, 60),
    "leapfrog coloring": ("leapfrog step", 10, 60),
    "part box": ("shape", 64, 320),
    "part turned box": ("shape", 64, 320),
    "part tapered box": ("shape", 64, 320),
    "part cylinder": ("shape", 64, 320),
    "part limb": ("shape", 64, 320),
    "part segment": ("shape", 64, 320),
    "choice guided": ("choice", 20, 120),
    "grow spaceship": ("search", 1, 3),
    "grow building": ("search", 1, 2),
    "grow building, compiled": ("search", 1, 2),
    "grow gnarly-tree": ("search", 1, 2),
}


def constant(value: object) -> object:
    """A constant of a model as data: a number, or the name of a kind with its parts."""
    if isinstance(value, int | float):
        return value
    kind = "tuple" if isinstance(value, tuple) else "list" if isinstance(value, list) else "vec"
    return {kind: [constant(float(part) if kind == "vec" else part) for part in value]}  # type: ignore[attr-defined]


def write_models() -> None:
    """Writes the models that are grown: core form, target, method."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in {path.partition(",")[0].split()[1] for path in PATHS if path.startswith("grow ")}:
        gallery_entry = entry(name)
        assert gallery_entry is not None, name
        core = gallery_entry.model.core()
        (FOLDER / f"{name}.core").write_text(core.text)
        (FOLDER / f"{name}.constants").write_text(json.dumps([constant(value) for value in core.constants]))
        target = gallery_entry.target()
        lines = [f"voxel {gallery_entry.voxel or 0.25}"]
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in target.vertices.tolist()]
        lines += [f"f {a} {b} {c}" for a, b, c in target.faces.tolist()]
        (FOLDER / f"{name}.mesh").write_text("\n".join(lines))
        (FOLDER / f"{name}.method").write_text(niwaki.methods.improve(particles=50, rounds=5).text()[0])


def build() -> Path:
    """Builds the program that repeats a path."""
    command = ["cargo", "build", "--release", "--locked", "--workspace", "--example", "counts"]
    subprocess.run(command, cwd=ROOT, check=True)
    return ROOT / "target" / "release" / "examples" / "counts"


def counted(program: Path, path: str, repeats: int) -> tuple[int, int]:
    """Instructions of so many repeats of a path, and their units of work."""
    name, _, compiled = path.partition(", ")
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", str(program), name]
    env = {**os.environ, "NIWAKI_JIT": "1" if compiled else "0", "RAYON_NUM_THREADS": "1"}
    done = subprocess.run(
        [*command, str(repeats), str(FOLDER)], env=env, capture_output=True, text=True, check=True
    )
    collected = re.search(r"Collected : (\d+)", done.stderr)
    assert collected is not None, done.stderr
    return int(collected[1]), int(done.stdout)


def price(program: Path, path: str) -> float:
    """Instructions that a unit of work of a path takes."""
    _, few, many = PATHS[path]
    (less, units), (more, all_units) = (counted(program, path, count) for count in (few, many))
    return (more - less) / (all_units - units)


def main(arguments: Sequence[str]) -> int:
    """Counts, prints, and returns 1 where a count differs from the table."""
    reading = argparse.ArgumentParser(
        description="Instructions of a unit of work, beside the committed table."
    )
    reading.add_argument(
        "paths", nargs="*", metavar="PATH", help='such as "step hmm"; all where none is named'
    )
    reading.add_argument("--write", action="store_true", help="write the table again")
    options = reading.parse_args(arguments)
    if unknown := set(options.paths) - set(PATHS):
        reading.error(f"no path {', '.join(sorted(unknown))}; there are: {', '.join(PATHS)}")
    if shutil.which("valgrind") is None:
        print("no valgrind found: instructions are not counted (apt-get install valgrind)")
        return 0
    write_models()
    program = build()
    table = json.loads(TABLE.read_text(encoding="utf-8")) if TABLE.exists() else {}
    differs = []
    print(f"{'path':24} {'unit':14} {'instructions':>14} {'table':>14} {'change':>8}")
    paths = list(options.paths or PATHS)
    # The longest first; a count does not depend on what else runs.
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        prices = dict(zip(paths[::-1], pool.map(lambda path: price(program, path), paths[::-1]), strict=True))
    for path in paths:
        now, before = round(prices[path]), table.get(path)
        change = float("inf") if before is None else now / before - 1
        print(f"{path:24} {PATHS[path][0]:14} {now:14,} {before or 0:14,} {change:+8.1%}", flush=True)
        if abs(change) > ALLOWED:
            differs.append(path)
        table[path] = now
    if options.write:
        TABLE.write_text(json.dumps({path: table[path] for path in PATHS if path in table}, indent=2) + "\n")
        return 0
    if differs:
        print(f"more than {ALLOWED:.0%} from the table: {', '.join(differs)}", file=sys.stderr)
    return 1 if differs else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
