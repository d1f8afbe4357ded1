"""The coverage of an archive of kinds, beside independent searches, choices held by hand, and CMA-ME.

    .venv/bin/python benches/kinds.py [--seeds 3] [--rounds 15] [--models chair,castle] [--sheets FOLDER]
    .venv/bin/python benches/kinds.py --costs [--seeds 3]

A few choices of each gallery model tell its results apart. Four ways lead to many designs:

* *archive*: one search that keeps the best run of each combination (`nw.archive(..., by=...)`);
* *independent*: searches for the best, with seeds of their own, until as much is spent;
* *held*: a search for each combination with its choices held, with an equal share;
* *CMA-ME* on the model as a function of a row of numbers (`flattened.py`). It needs `pip install ribs`, which is in no
  lock; where it is not installed it is left out, with a line.

Each way has the evaluations of the archive, and then its CPU seconds. An evaluation is a step of a particle: a run of
CMA-ME has one for each primitive, and one more. CPU seconds are those of the process (`time.process_time`), on one
thread, after the model is compiled. Those of CMA-ME lack the runs in plain Python that turn numbers into choices, and
what the library compiles at its first use.

*Coverage* is the share of combinations with a result. *QD* is the sum over combinations of what their best results
have above `FLOOR` (Pugh, Soros & Stanley 2016). `--costs` compares `diverse=10` with one search at the
default effort, and makes up to 200 houses of as many kinds. `--sheets` draws what `diverse=10` gives for five models.
"""

import argparse
import itertools
import os
import statistics
import sys
import warnings
from collections.abc import Iterator
from importlib.util import find_spec
from math import isfinite, prod
from pathlib import Path
from typing import Any

# Matrices on one thread; the library of matrices reads this when it is loaded.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import flattened
import niwaki as nw
from niwaki.gallery import entry
from niwaki.search import named

Values = tuple[Any, ...]
Grid = dict[str, Values]
#: Coverage, QD, best log score, evaluations, CPU seconds.
Row = tuple[float, float, float, float, float]

#: For each model the choices that tell results apart, and their values.
MODELS: dict[str, Grid] = {
    "chair": {
        "part[0]/part/discrete_uniform": ("straight", "pedestal", "sled"),
        "part[1]/part/kind": ("panel", "spindles", "rungs", "hoop"),
    },
    "village-house": {
        "house/categorical": ("gable", "hip", "flat"),
        "side[0]/beside": ("nothing", "wing", "lean-to"),
    },
    "spaceship": {"while[0]/kind": (0, 1, 2), "while[1]/kind": (0, 1, 2)},
    "castle": {"discrete_uniform": (0, 1, 2, 3, 4), "has_keep": (False, True)},
}
#: The choices of a house that make 384 kinds together.
OF_HOUSES = (
    "house/categorical",
    "house/has_chimney",
    *(
        f"side[{side}]/{choice}"
        for side in (0, 1)
        for choice in ("beside", "house/categorical", "house/has_chimney")
    ),
)
#: Most results of an archive.
MOST = 100
#: What the ways have in common.
EQUAL = ("evaluations", "CPU")
#: The log score that counts as nothing.
FLOOR = -100.0
#: Models whose results are drawn.
DRAWN = ("chair", "village-house", "gnarly-tree", "simple-ship", "castle")


def main() -> int:
    """Measure each model, and print a row for each way."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--models", default=",".join(MODELS))
    parser.add_argument("--costs", action="store_true")
    parser.add_argument("--sheets", type=Path)
    options = parser.parse_args()
    warnings.simplefilter("ignore", nw.search.SearchWarning)
    if options.costs:
        costs(options.seeds)
        houses(options.seeds)
        return 0
    if find_spec("ribs") is None:
        print("CMA-ME is left out: ribs is not installed", file=sys.stderr)
    print("| model | way | equal | coverage | QD | best | evaluations | CPU s |\n" + "| --- " * 8 + "|")
    for name in filter(None, options.models.split(",")):
        rows = [measured(name, MODELS[name], seed, options.rounds) for seed in range(options.seeds)]
        for way, equal in rows[0]:
            columns = zip(*(row[way, equal] for row in rows), strict=True)
            covered, quality, best, count, seconds = (statistics.mean(column) for column in columns)
            scores = f"{covered:.0%} | {quality:.1f} | {best:.1f} | {count:,.0f} | {seconds:.2f}"
            print(f"| {name} | {way} | {equal} | {scores} |", flush=True)
    if options.sheets is not None:
        options.sheets.mkdir(parents=True, exist_ok=True)
        for name in DRAWN:
            drawn(name, options.rounds).save(options.sheets / f"{name}.png")
    return 0


def measured(name: str, grid: Grid, seed: int, rounds: int) -> dict[tuple[str, str], Row]:
    """Measure each way with the evaluations, and with the CPU seconds, of an archive."""
    # The archive is not told which combinations count: others are possible, and it keeps them, too.
    archive = grown(
        name, 1000 * seed, method=nw.improve(rounds=rounds, diverse=MOST, by=list(grid), margin=None)
    )
    limits = spent(archive)
    runs = [(sample.choices, sample.log_score) for sample in archive]
    rows = {("archive", "both"): row(grid, best_of(grid, runs), *limits)}
    streams = {"independent": independent(name, seed, rounds)}
    if find_spec("ribs") is not None:
        streams["CMA-ME"] = flattened.cma_me(archive.search, grid, seed + 1)
    for way, stream in streams.items():
        rows |= {(way, equal): of_way for equal, of_way in until(limits, grid, stream).items()}
    for place, equal in enumerate(EQUAL):
        rows["held", equal] = held(name, grid, archive, seed, place)
    return rows


def independent(name: str, seed: int, rounds: int) -> Iterator[flattened.Evaluated]:
    """Search for the best again and again."""
    count, seconds = 0.0, 0.0
    for number in itertools.count(1):
        result = grown(name, 1000 * seed + number, rounds=rounds)
        work, time = spent(result)
        count, seconds = count + work, seconds + time
        yield result.best.choices, result.best.log_score, count, seconds


def until(limits: tuple[float, float], grid: Grid, stream: Iterator[flattened.Evaluated]) -> dict[str, Row]:
    """Return what a way has when it has spent as many evaluations, and as many CPU seconds, as the limits say."""
    best: dict[Values, float] = {}
    rows: dict[str, Row] = {}
    for choices, score, *so_far in stream:
        best = best_of(grid, [(choices, score)], best)
        for equal, now, limit in zip(EQUAL, so_far, limits, strict=True):
            if now >= limit and equal not in rows:
                rows[equal] = row(grid, best, *so_far)
        if len(rows) == len(EQUAL):
            break
    return rows


def held(name: str, grid: Grid, archive: nw.Result, seed: int, place: int) -> Row:
    """Search with the choices of each combination held; `place` says what is equal."""
    limit, totals, runs = spent(archive)[place], (0.0, 0.0), []
    combinations = list(itertools.product(*grid.values()))
    for left, values in zip(range(len(combinations), 0, -1), combinations, strict=True):
        hold = dict(zip(grid, values, strict=True))
        # The first population is five rounds.
        first = spent(grown(name, 1000 * seed, rounds=1, hold=hold))[place]
        rounds = max(1, round(5.0 * ((limit - totals[place]) / left / first - 1.0)))
        result = grown(name, 1000 * seed, rounds=rounds, hold=hold)
        work, time = spent(result)
        totals = totals[0] + work, totals[1] + time
        # A held choice counts in the score: the run is scored again where nothing is held.
        choices = result.best.choices
        runs.append((choices, flattened.scored(archive.search, choices)[0]))
    return row(grid, best_of(grid, runs), *totals)


def best_of(
    grid: Grid, runs: list[tuple[dict[str, Any], float]], before: dict[Values, float] | None = None
) -> dict[Values, float]:
    """Return the best score of each combination of the grid in some runs, and of those from before."""
    best = dict(before or {})
    for choices, score in runs:
        values = tuple(choices.get(choice) for choice in grid)
        if isfinite(score) and all(
            value in of_choice for value, of_choice in zip(values, grid.values(), strict=True)
        ):
            best[values] = max(best.get(values, FLOOR), score)
    return best


def row(grid: Grid, best: dict[Values, float], count: float, seconds: float) -> Row:
    """Return the coverage, the QD score and the best score, with what was spent."""
    combinations = prod(len(values) for values in grid.values())
    quality = sum(score - FLOOR for score in best.values())
    return len(best) / combinations, quality, max(best.values(), default=FLOOR), count, seconds


def grown(name: str, seed: int, **settings: Any) -> nw.Result:
    """Grow a gallery model into its target, on one thread."""
    model = entry(name)
    return nw.grow(model.model, model.target(), voxel=model.voxel, seed=seed, threads=1, **settings)


def spent(result: nw.Result) -> tuple[float, float]:
    """Return the work of a search, in steps of particles, and its CPU seconds."""
    return sum(step.work for step in result.info.rounds) + result.info.other_work, result.cpu_seconds


def costs(seeds: int) -> None:
    """Compare the costs of ten results with those of one at the default effort."""
    print("| model | work of ten / of one | CPU s of one | CPU s of ten | ratio |\n" + "| --- " * 5 + "|")
    for name in DRAWN:
        pairs = [(spent(grown(name, seed)), spent(grown(name, seed, diverse=10))) for seed in range(seeds)]
        single, ten = (
            [statistics.mean(column) for column in zip(*rows, strict=True)]
            for rows in zip(*pairs, strict=True)
        )
        print(
            f"| {name} | {ten[0] / single[0]:.1f} | {single[1]:.2f} | {ten[1]:.2f} | {ten[1] / single[1]:.1f} |",
            flush=True,
        )


def houses(seeds: int) -> None:
    """Make 200 houses of 200 kinds, and print a row for each rule and each effort."""
    model = entry("village-house")
    print("| by | effort | houses | CPU s | best | median |\n" + "| --- " * 6 + "|")
    for by, effort in (("kind", 1), (OF_HOUSES, 1), (OF_HOUSES, 4)):
        rows = []
        for seed in range(seeds):
            kinds = nw.archive(
                model.model,
                model.target(),
                kinds=200,
                by=by,
                voxel=model.voxel,
                seed=seed,
                effort=effort,
                threads=1,
            )
            scores = [kind.log_score for kind in kinds]
            rows.append((len(kinds), kinds.result.cpu_seconds, scores[0], statistics.median(scores)))
        number, *rest = (statistics.mean(column) for column in zip(*rows, strict=True))
        name = by if isinstance(by, str) else f"{len(by)} choices"
        print(f"| {name} | {effort} | {number:.0f} | {' | '.join(f'{x:.1f}' for x in rest)} |", flush=True)


def drawn(name: str, rounds: int) -> Any:
    """Draw ten results of ten kinds."""
    result = grown(name, 1, method=nw.improve(rounds=rounds, diverse=10))
    captions = [
        f"{sample.log_score:.1f}: {', '.join(value for _, value in kind)}"
        for sample, kind in zip(result, named(result), strict=True)
    ]
    return result.sheet(captions=captions, columns=5, size=(300, 225))


if __name__ == "__main__":
    raise SystemExit(main())
