"""The cost of a primitive in each sketch, beside the lowest possible cost; and what a search spends its time on.

    make bench-sketches                        # or: .venv/bin/python benches/primitives.py [SEED] [COUNT]

Median nanoseconds of adding a primitive to a scene of 50, of a copy with one primitive more (as a particle does it), of
removing it, and of the score. Beside them, in the same run: a loop by hand for the one case, four cells or boxes at a
time, without sharing or undo; the tests of parry3d after the same loop over boxes; and trimesh for voxels of a mesh.
The loop for volumes counts cells whose middle is inside, the engine those that are touched, which are more. The answers
of the other loops and of parry3d must be the engine's, but for pixels on an edge: one in a thousand.

Then the share of parts of the engine in searches of chapter 5, by samples of the processor's clock (`perf`, where it is
installed): the function that was running, by the crate and the file that it is from.

Prints JSON lines, then tables. Needs cargo.
"""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import niwaki
import trimesh
from machine import CACHE, machine, run
from rich.console import Console
from rich.table import Table

HERE = Path(__file__).resolve().parent
#: Answers of a loop that may differ, as a share: pixels whose middle is on an edge.
ALLOWED = 1e-3
#: Experiments of chapter 5 that are looked into.
SEARCHES = ("building", "ship", "tree", "tree-and-ledges", "digits-of-pipes")
#: What a function belongs to: the first that its name matches.
PARTS = (
    ("sketches", r"niwaki_geom::(sketch|bricks|voxel|intersect|view|plane|tree|window)"),
    ("shapes", r"niwaki_geom::"),
    ("streams and densities", r"niwaki_math::"),
    ("the machine", r"niwaki_vm::"),
    ("copying and memory", r"malloc|calloc|free|memmove|memcpy|memset|drop_in_place|Arc<|alloc::|clone"),
    ("the search", r"niwaki_(run|propose|chain|particles|search|continuous|guide)::"),
    ("threads", r"rayon|crossbeam|sched_yield|futex"),
)


def main(seed: int = 1, count: int = 200) -> int:
    """Measure, print, and return 1 when an answer is wrong."""
    rows = measured(seed, count)
    wrong = 0
    table = Table(
        "sketch", "primitive", "add", "copy", "remove", "score", "by hand", "ratio", "parry3d", "ratio"
    )
    for row in sorted(
        rows, key=lambda row: list(dict.fromkeys(r["sketch"] for r in rows)).index(row["sketch"])
    ):
        hand, parry, of = (row.get(name) or math.nan for name in ("hand", "parry", "of"))
        differ = row.get("differ")
        if row["sketch"] != "volume" or row["kind"] == "aligned box":
            wrong += differ is not None and differ > ALLOWED * of
            wrong += (row.get("parry differ") or 0) > ALLOWED * of
        print(json.dumps(row | machine()))
        table.add_row(
            row["sketch"],
            row["kind"],
            *(f"{row[name]:,.0f}" for name in ("add", "copy", "remove", "score")),
            *(
                text
                for limit in (hand, parry)
                for text in (formatted(limit), formatted(row["copy"] / limit, 1))
            ),
        )
    console = Console(width=120)
    console.print(table)
    times = {row["kind"]: row["make"] for row in rows}
    console.print("making the shape, ns: " + ", ".join(f"{kind} {ns:,.0f}" for kind, ns in times.items()))
    for triangles, seconds in voxelised().items():
        console.print(f"trimesh, voxels of a mesh of {triangles} triangles: {1e9 * seconds:,.0f} ns")
    if shutil.which("perf") is None:
        console.print("no perf found: what a search spends its time on is not measured")
    else:
        console.print(as_table(shares(seed)))
    if wrong:
        console.print(f"{wrong} answers are wrong")
    return int(wrong > 0)


def formatted(value: float, digits: int = 0) -> str:
    """A number, or nothing."""
    return "" if math.isnan(value) else f"{value:,.{digits}f}"


def measured(seed: int, count: int) -> list[dict]:
    """A row for each sketch and each kind of primitive, nanoseconds."""
    build = "cargo build --release --locked --quiet --target-dir".split()
    target = CACHE / "sketches"
    run(*build, str(target), folder=HERE / "sketches")
    command = [str(target / "release" / "sketches"), str(seed), str(count)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def voxelised() -> dict[int, float]:
    """Seconds that trimesh takes for the filled cells of a ball one unit large, in cells of a tenth."""
    medians = {}
    for count in ((10, 6), (72, 72)):
        ball = trimesh.creation.uv_sphere(0.5, count=list(count))
        times = []
        for _ in range(5):
            start = time.perf_counter()
            ball.voxelized(0.1).fill()
            times.append(time.perf_counter() - start)
        medians[len(ball.faces)] = statistics.median(times)
    return medians


def shares(seed: int) -> dict[str, Counter[str]]:
    """Samples of each part, by search."""
    counters = {}
    # The engine of the package has no names of functions: a copy of the package gets one that has.
    run(*"cargo build --release --locked --quiet -p niwaki-py".split(), folder=HERE.parent)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "samples"
        copy = Path(folder) / "niwaki"
        shutil.copytree(
            Path(niwaki.__file__).parent, copy, ignore=shutil.ignore_patterns("_engine*", "__pycache__")
        )
        shutil.copy(HERE.parent / "target" / "release" / "lib_engine.so", copy / "_engine.abi3.so")
        around = os.environ | {"PYTHONPATH": folder}
        for name in SEARCHES:
            code = f"import experiments; experiments.experiment({name!r}).run(seed={seed}, threads=1)"
            record = ["perf", "record", "-q", "-e", "cpu-clock", "-F", "499", "-o", str(place), "--"]
            subprocess.run(
                [*record, sys.executable, "-c", code], check=True, cwd=HERE, env=around, capture_output=True
            )
            report = [
                "perf",
                "report",
                "-i",
                str(place),
                "--stdio",
                "--no-children",
                "-F",
                "sample,dso,symbol",
            ]
            formatted = subprocess.run(report, check=True, capture_output=True, text=True).stdout
            counters[name] = Counter()
            for line in formatted.splitlines():
                match = re.match(r"\s*(\d+)\s+(\S+)\s+\[.\]\s+(.*)", line)
                # What Python does before and after is not the search.
                if match and ("_engine" in match[2] or "libc" in match[2] or "kernel" in match[2]):
                    counters[name][part_of(match[3])] += int(match[1])
    return counters


def part_of(symbol: str) -> str:
    """The part of the engine that a function belongs to."""
    return next((part for part, pattern in PARTS if re.search(pattern, symbol)), "other")


def as_table(counters: dict[str, Counter[str]]) -> Table:
    """The shares of the parts, %."""
    table = Table("search", *(part for part, _ in PARTS), "other", "samples")
    for name, counts in counters.items():
        total = counts.total()
        parts = [*(part for part, _ in PARTS), "other"]
        table.add_row(name, *(f"{100 * counts[part] / total:.0f} %" for part in parts), str(total))
    return table


if __name__ == "__main__":
    sys.exit(main(*(int(argument) for argument in sys.argv[1:])))
