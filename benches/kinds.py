"""The coverage of an archive of kinds, beside independent searches and beside choices held by hand, at equal work.

    .venv/bin/python benches/kinds.py [--seeds 3] [--rounds 15] [--sheets FOLDER]

Two choices of each gallery model tell its results apart. Three ways to many designs have the same work:

* *archive*: one search that keeps the best run of each combination (`nw.archive(..., by=...)`);
* *independent*: searches for the best, with seeds of their own, until the work is spent;
* *held*: a search for each combination with its choices held, with an equal share of the work.

*Coverage* is the share of combinations with a result. *QD* is the sum over combinations of what their best results
have above `FLOOR` (Pugh, Soros & Stanley 2016). `--sheets` draws what `diverse=10` gives for five models.
"""

import argparse
import itertools
import statistics
import warnings
from pathlib import Path

import niwaki as nw
from niwaki.gallery import entry
from niwaki.search import named

#: For each model the choices that tell results apart, and their values.
MODELS = {
    "chair": {
        "part[0]/part/discrete_uniform": ("straight", "pedestal", "sled"),
        "part[1]/part/kind": ("panel", "spindles", "rungs"),
    },
    "village-house": {
        "house/categorical": ("gable", "hip", "flat"),
        "side[0]/beside": ("nothing", "wing", "lean-to"),
    },
}
#: Most results of an archive.
MOST = 100
#: The log score that counts as nothing.
FLOOR = -100.0
#: Models whose results are drawn.
DRAWN = ("chair", "village-house", "gnarly-tree", "simple-ship", "castle")


def main() -> int:
    """Measure each model, and print a row for each way."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--sheets", type=Path)
    options = parser.parse_args()
    print("| model | way | coverage | QD | best | work |\n| --- | --- | --- | --- | --- | --- |")
    for name, choices in MODELS.items():
        rows = [measured(name, choices, seed, options.rounds) for seed in range(options.seeds)]
        for way in rows[0]:
            columns = zip(*(row[way] for row in rows), strict=True)
            covered, quality, best, work = (statistics.mean(column) for column in columns)
            print(f"| {name} | {way} | {covered:.0%} | {quality:.1f} | {best:.1f} | {work:,.0f} |")
    if options.sheets is not None:
        options.sheets.mkdir(parents=True, exist_ok=True)
        for name in DRAWN:
            drawn(name, options.rounds).save(options.sheets / f"{name}.png")
    return 0


def measured(
    name: str, choices: dict[str, tuple[str, ...]], seed: int, rounds: int
) -> dict[str, tuple[float, ...]]:
    """Measure the coverage, the QD score, the best score and the work of each way."""
    combinations = list(itertools.product(*choices.values()))
    # The archive is not told which combinations count: others are possible, and it keeps them, too.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", nw.search.SearchWarning)
        method = nw.improve(rounds=rounds, diverse=MOST, by=list(choices))
        archive = grown(name, 1000 * seed, rounds, method=method)
    work = spent(archive)
    ways = {"archive": (list(archive), work), "independent": ([], 0), "held": ([], 0)}
    for number in itertools.count(1):
        samples, so_far = ways["independent"]
        if so_far >= work:
            break
        result = grown(name, 1000 * seed + number, rounds)
        ways["independent"] = [*samples, *result], so_far + spent(result)
    for left, values in zip(range(len(combinations), 0, -1), combinations, strict=True):
        samples, so_far = ways["held"]
        hold = dict(zip(choices, values, strict=True))
        # The first population is five rounds.
        first = grown(name, 1000 * seed, 1, hold=hold).info.rounds[0].work
        each = max(1, round(5.0 * ((work - so_far) / left / first - 1.0)))
        result = grown(name, 1000 * seed, each, hold=hold)
        ways["held"] = [*samples, *result], so_far + spent(result)
    table = {}
    for way, (samples, of_way) in ways.items():
        best: dict[tuple[str, ...], float] = {}
        for sample in samples:
            values = tuple(sample.choices.get(choice, "none") for choice in choices)
            if values in combinations:
                best[values] = max(best.get(values, FLOOR), scored(archive, sample))
        quality = sum(score - FLOOR for score in best.values())
        table[way] = len(best) / len(combinations), quality, max(best.values()), of_way
    return table


def grown(name: str, seed: int, rounds: int, **settings) -> nw.Result:
    """Grow a gallery model into its target."""
    model = entry(name)
    if "method" not in settings:
        settings["rounds"] = rounds
    return nw.grow(model.model, model.target(), voxel=model.voxel, seed=seed, **settings)


def spent(result: nw.Result) -> int:
    """Return the work of a search, in steps of particles."""
    return sum(step.work for step in result.info.rounds) + result.info.other_work


def scored(of: nw.Result, sample: nw.Sample) -> float:
    """Return the score of a run in the search of another result, where nothing is held."""
    run = nw.run(of.model, score=of.score, choices=sample.choices)
    return run.best.log_score


def drawn(name: str, rounds: int):
    """Draw ten results of ten kinds."""
    result = grown(name, 1, rounds, method=nw.improve(rounds=rounds, diverse=10))
    captions = [
        f"{sample.log_score:.1f}: {', '.join(value for _, value in kind)}"
        for sample, kind in zip(result, named(result), strict=True)
    ]
    return result.sheet(captions=captions, columns=5, size=(300, 225))


if __name__ == "__main__":
    raise SystemExit(main())
