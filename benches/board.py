"""The board of searches, which judges every change of the default: many kinds of problems, each by many methods.

    make bench-searches                                  # 20 seeds of each
    QUICK=1 make bench-searches                          # 5 seeds, no costly problem: about ten minutes
    SEEDS=40 METHODS=default make bench-searches         # up to 40
    PROBLEMS="ship,forked stems" METHODS=default,chain SEEDS=8 make bench-searches
    SET=held_out make bench-searches                     # the judgement, at the end: not while a search is changed
    TIMES=4 make bench-searches                          # four times the CPU seconds; the default takes what it takes
    AGAINST=1a2b3c make bench-searches                   # beside what an older version left (hash or commit)
    PAIR="chain,default" make bench-searches             # two methods, problem by problem
    SET=commit SEEDS=100 PARTS=10 PART=3 ...             # the third tenth of 100 seeds drawn from the commit's hash
    BEFORE_AND_AFTER=1 make bench-searches               # the default and fifteen rounds, without the other methods

A user's search, `niwaki.grow(model, target)`, and other methods with as many CPU seconds: `searches/methods.py`. Two
worker processes with one thread each: searches run with `threads=1`, and the libraries of matrices are limited by
OMP_NUM_THREADS and OPENBLAS_NUM_THREADS.

Each search is a line of out/searches/records.jsonl (OUT names another folder); what this version of the package has
done before is not done again. Leaves tables.md and a picture of each problem in the folder, with the default's median
and worst result beside the target (PICTURES=0: none).
"""

import os
import sys
import time
from pathlib import Path

# A pool of threads that spins for matrices would count as ours; worker processes inherit these.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

from collections.abc import Callable, Iterable, Iterator, Sequence
from multiprocessing import get_context
from typing import Any

from searches import sheets, table
from searches.methods import METHODS, Method
from searches.problems import PROBLEMS, Problem
from searches.records import Records, commit, version
from searches.searching import searched, sized
from searches.seeds import COMMIT, FULL, MOST, MOST_OF_COMMIT, QUICK, SETS, drawn

WORKERS = 2


def measure(
    records: Records,
    problems: Sequence[Problem],
    methods: Sequence[Method],
    seeds: Sequence[int],
    times: float = 1.0,
    workers: int = WORKERS,
) -> int:
    """Do what is missing, with so many times the CPU seconds of the default; return how many searches that were.

    One worker is this process.
    """
    if workers == 1:
        return measure_by(map, records, problems, methods, seeds, times)
    with get_context("spawn").Pool(workers) as pool:
        return measure_by(pool.imap_unordered, records, problems, methods, seeds, times)


def measure_by(
    each: Callable[..., Iterable[dict[str, Any]]],
    records: Records,
    problems: Sequence[Problem],
    methods: Sequence[Method],
    seeds: Sequence[int],
    times: float,
) -> int:
    """Measure with a function that maps: first what the default costs, then sizes, then the searches."""
    default, alternatives = METHODS[0], [how for how in methods if how.size]
    alone = [problem for problem in problems if alternatives and records.size(problem.name, default) is None]
    for row in each(sized, [(problem.name, default.name, 0.0) for problem in alone]):
        records.add(row | {"times": 1.0})
    sizes = [
        (problem.name, how.name, times * records.size(problem.name, default)["pilot_cpu"])
        for problem in problems
        for how in alternatives
        if records.size(problem.name, how, times) is None
    ]
    for done, row in enumerate(each(sized, sizes)):
        records.add(row | {"times": times})
        say(f"sizes {done + 1} of {len(sizes)}")
    jobs = list(missing(records, problems, methods, seeds, times))
    for done, row in enumerate(each(searched, jobs)):
        records.add(row | {"times": times})
        say(f"searches {done + 1} of {len(jobs)}: {row['problem']}, {row['method']}")
    return len(jobs)


def missing(
    records: Records,
    problems: Sequence[Problem],
    methods: Sequence[Method],
    seeds: Sequence[int],
    times: float,
) -> Iterator[tuple[str, str, int, int]]:
    """Searches to do: methods take turns on each seed, so that a busy machine is busy for all of them."""
    for problem in problems:
        for seed in seeds:
            for how in methods:
                if not records.has(how, problem.name, seed, times):
                    size = records.size(problem.name, how, times)["size"] if how.size else 0
                    yield problem.name, how.name, size, seed


def say(text: str) -> None:
    """A line that replaces itself, where somebody looks."""
    if sys.stderr.isatty():
        print(f"\r{text:<78}", end="", file=sys.stderr, flush=True)


def chosen(table: Sequence, variable: str) -> list:
    """The rows of a table that a variable of the environment names, all without one."""
    names = [name.strip() for name in os.environ.get(variable, "").split(",") if name.strip()]
    known = {row.name: row for row in table}
    if unknown := [name for name in names if name not in known]:
        raise SystemExit(f"{variable}: no {unknown[0]!r}; there are {', '.join(known)}")
    return [known[name] for name in names] or list(table)


def main() -> int:
    """Measure what is missing, write the tables and the pictures."""
    started = time.monotonic()
    problems, methods = chosen(PROBLEMS, "PROBLEMS"), chosen(METHODS, "METHODS")
    if os.environ.get("BEFORE_AND_AFTER"):
        methods = [entry for entry in METHODS if not entry.size]
    if os.environ.get("QUICK") and not os.environ.get("PROBLEMS"):
        problems = [entry for entry in problems if not entry.is_costly]
    count = int(os.environ.get("SEEDS") or (QUICK if os.environ.get("QUICK") else FULL))
    name = os.environ.get("SET") or "tuning"
    most = MOST_OF_COMMIT if name == COMMIT else MOST
    if name not in (*SETS, COMMIT) or not 0 < count <= most:
        raise SystemExit(f"SET is one of {', '.join((*SETS, COMMIT))}, SEEDS between 1 and {most}")
    seeds = drawn(os.environ.get("COMMIT") or commit(), count) if name == COMMIT else SETS[name][:count]
    parts, part = (int(os.environ.get(variable) or 0) for variable in ("PARTS", "PART"))
    to_do = [seed for place, seed in enumerate(seeds) if not part or place % parts == part - 1]
    folder = Path(os.environ.get("OUT") or "out/searches")
    records = Records(folder / "records.jsonl")
    times = float(os.environ.get("TIMES") or 1.0)
    done = measure(records, problems, methods, to_do, times)
    say("")
    rows = [row for row in records.searches(times=times) if row["seed"] in seeds]
    names = [how.name for how in methods]
    lines = [
        f"Version {version()}, commit {commit()}, {name} seeds, {len(seeds)} searches of each, "
        f"{times:g} times the default's CPU.",
        *table.defaults(rows),
        "",
        *table.methods(rows, names),
        "",
        *table.against(rows, [entry for entry in names if entry != "default"], rows, "default"),
    ]
    pair = [entry.strip() for entry in os.environ.get("PAIR", "").split(",") if entry.strip()]
    if not pair and os.environ.get("BEFORE_AND_AFTER"):
        pair = [entry.name for entry in methods]
    if pair:
        lines += ["", *table.by_problem(rows, pair[0], rows, pair[-1])]
    if before := os.environ.get("AGAINST"):
        older = records.searches(before, times)
        lines += ["", *table.against(rows, names, older)]
        for entry in names:
            lines += ["", *table.by_problem(rows, entry, older, entry)]
    (folder / "tables.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    if os.environ.get("PICTURES") != "0":
        for entry in problems:
            print(sheets.drawn(entry, rows, folder))
    print(f"{done} searches in {time.monotonic() - started:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
