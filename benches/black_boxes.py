"""Hidden parameters of sixteen generators, sought by `nw.FitLoop` and by optimisers of a score.

    make bench-fit                                                  # five seeds, 1,000 evaluations: many hours
    SEEDS=1 BUDGET=300 make bench-fit                               # a look
    GENERATORS=table,gear SEARCHES=fit,cma SEEDS=2 make bench-fit   # some
    WORKERS=1 make bench-fit                                        # one worker process; by default there are two

Each search of a problem is a line of out/fit/records.jsonl (OUT names another folder); what is there is not done
again. The eight old generators have two targets each, the eight fresh ones have one. Leaves tables.md in the folder.
The tables have all records of the folder: what was done with a larger budget counts for fewer evaluations, too. The
libraries of matrices are limited to one thread. Nevergrad, pymoo and openscad-evaluator need
packages under the GPL or the LGPL, and are in no lock: what is not installed is left out, with a line. A peer that
raises has the rows of what it did before.
"""

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

from collections.abc import Iterator
from importlib.util import find_spec
from multiprocessing import get_context
from typing import Any

from fit import ours, peers, table
from fit.problems import GENERATORS, MARKS, Problem
from lines import Lines

Job = tuple[str, str, int, int, int]


def searched(job: Job) -> list[dict[str, Any]]:
    """Do one search; return a row for each number of evaluations at which it is judged."""
    search, generator, target, seed, budget = job
    problem = Problem(GENERATORS[generator], target, budget)
    if search == "fit":
        ours.search(problem, seed)
    else:
        try:
            peers.search(problem, search, seed)
        except Exception as error:
            print(f"{search} ended on {generator} {target}, seed {seed}: {error}", file=sys.stderr)
    return [
        dict(search=search, generator=generator, target=target, seed=seed, budget=budget, evaluations=mark)
        | dict(truth=problem.truth, overhead=1000 * judged.seconds / mark)
        | problem.measures(judged)
        for mark, judged in problem.judged.items()
    ]


def jobs(searches: list[str], generators: list[str], seeds: int, budget: int) -> Iterator[Job]:
    for seed in range(seeds):
        for generator in generators:
            for target in (0,) if GENERATORS[generator].is_fresh else (0, 1):
                for search in searches:
                    yield search, generator, target, seed, budget


def chosen(names: list[str], variable: str) -> list[str]:
    values = [name.strip() for name in os.environ.get(variable, "").split(",") if name.strip()]
    if unknown := [name for name in values if name not in names]:
        raise SystemExit(f"{variable}: no {unknown[0]!r}; there are {', '.join(names)}")
    return values or names


def installed(searches: list[str], generators: list[str]) -> tuple[list[str], list[str]]:
    """Leave out what needs a library that is not installed, with a line for each."""
    lacking = {name for name, library in peers.LIBRARIES.items() if find_spec(library) is None}
    for name in sorted(lacking & set(searches)):
        print(f"{name} is left out: {peers.LIBRARIES[name]} is not installed", file=sys.stderr)
    if find_spec("openscad_evaluator") is None and "candle" in generators:
        print("candle is left out: openscad-evaluator is not installed", file=sys.stderr)
        generators = [name for name in generators if name != "candle"]
    return [name for name in searches if name not in lacking], generators


def main() -> int:
    searches = chosen(["fit", *peers.PEERS], "SEARCHES")
    generators = chosen(list(GENERATORS), "GENERATORS")
    searches, generators = installed(searches, generators)
    seeds, budget = int(os.environ.get("SEEDS") or 5), int(os.environ.get("BUDGET") or max(MARKS))
    folder = Path(os.environ.get("OUT") or "out/fit")
    records = Lines(folder / "records.jsonl")
    done = {
        tuple(row[name] for name in ("search", "generator", "target", "seed", "budget"))
        for row in records.rows
    }
    missing = [job for job in jobs(searches, generators, seeds, budget) if job not in done]
    with get_context("spawn").Pool(int(os.environ.get("WORKERS") or 2)) as pool:
        for number, rows in enumerate(pool.imap_unordered(searched, missing)):
            for row in rows:
                records.add(row)
            names = {f"{row['search']}, {row['generator']}" for row in rows}
            print(f"searches {number + 1} of {len(missing)}: {', '.join(names)}", flush=True)
    parts: list[str] = []
    for title, fresh in (("Old generators", False), ("Fresh generators", True)):
        rows = [row for row in table.distinct(records.rows) if GENERATORS[row["generator"]].is_fresh == fresh]
        parts += [f"## {title}", "", *table.by_search(rows), ""]
        for mark in MARKS:
            if any(row["evaluations"] == mark for row in rows):
                parts += [f"After {mark} evaluations:", "", *table.by_problem(rows, mark), ""]
    (folder / "tables.md").write_text("\n".join(parts).rstrip() + "\n")
    print("\n".join(parts))
    return 0


if __name__ == "__main__":
    sys.exit(main())
