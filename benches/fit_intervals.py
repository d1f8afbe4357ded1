"""Do 90 % intervals of `nw.fit` cover hidden parameters, and do probabilities of switches mean what they say?

    make bench-fit-intervals                          # 32 problems, 150 evaluations each: an hour
    GENERATORS=boat,lamp TARGETS=1 make bench-fit-intervals

The generators are eight of `make bench-fit` with a volume as goal. The targets are others, from 10 on: they have chosen
nothing. Each generator has exact targets, and rough ones, whose vertices are moved. A problem is a line of
out/fit/intervals.jsonl; what is there is not done again. Leaves intervals.md in the folder.
"""

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

from typing import Any

import niwaki as nw
import numpy as np
from fit import ours
from fit.parameters import canonical
from fit.problems import GENERATORS, Problem
from lines import Lines

#: The first target, evaluations of a search, and the standard deviation of the vertices of a rough target.
FIRST, EVALUATIONS, ROUGH = 10, 150, 0.012

NAMES = ("boat", "lamp", "bridge", "vase", "gear", "chair", "stair", "building")


def answers_of(name: str, target: int, rough: float) -> dict[str, Any]:
    """Search one problem, and ask for every hidden parameter how sure it is."""
    problem = Problem(GENERATORS[name], target, EVALUATIONS, rough)
    loop = nw.FitLoop(ours.ranges(problem.parameters), problem.goal, target)
    while problem.count < EVALUATIONS:
        for point in loop.ask(8):
            if problem.count < EVALUATIONS:
                ours.tell(problem, loop, point)
    used, hidden = canonical(problem.parameters, problem.hidden)
    reals, levels = [], []
    for row in problem.parameters:
        if row.name not in used:
            continue
        answer = loop.answers.interval(row.name)
        truth = hidden[row.name]
        if row.kind == "real":
            low, high = row.domain
            if answer.low is None or answer.high is None:
                reals.append([row.name, None, 1.0, answer.identified, answer.used])
                continue
            is_inside = answer.low <= truth <= answer.high
            wide = (answer.high - answer.low) / (high - low)
            reals.append([row.name, bool(is_inside), wide, answer.identified, answer.used])
        else:
            shares = answer.levels or {}
            best = max(shares.values(), default=0.0)
            levels.append([row.name, shares.get(truth), best, answer.identified, len(row.levels)])
    power = loop.answers.interval(problem.parameters[0].name)
    return dict(
        generator=name,
        target=target,
        rough=rough,
        score=problem.best,
        truth=problem.truth,
        power=power.power,
        covered=power.covered,
        reals=reals,
        levels=levels,
    )


def table(rows: list[dict[str, Any]]) -> list[str]:
    """Coverage and widths of intervals; for switches, how often the most probable value is true, by its probability."""
    lines = [
        "| targets | problems | reals | inside | identified reals | inside | median width, share of the range |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for title, is_rough in (("exact", False), ("rough", True)):
        here = [row for row in rows if bool(row["rough"]) == is_rough]
        reals = [real for row in here for real in row["reals"] if real[1] is not None]
        sure = [real for real in reals if real[3]]
        if not sure:
            continue
        lines.append(
            f"| {title} | {len(here)} | {len(reals)} | {np.mean([real[1] for real in reals]):.2f} | {len(sure)} | "
            f"{np.mean([real[1] for real in sure]):.2f} | {np.median([real[2] for real in sure]):.2f} |"
        )
    lines += [
        "",
        "| probability of the most probable value | whole numbers, switches, choices | it is true |",
        "| --- | --- | --- |",
    ]
    levels = [level for row in rows for level in row["levels"] if level[1] is not None]
    for low, high in ((0.0, 0.6), (0.6, 0.8), (0.8, 0.95), (0.95, 1.01)):
        some = [level for level in levels if low <= level[2] < high]
        if some:
            right = np.mean([level[1] == level[2] for level in some])
            lines.append(f"| {low:.2f} to {min(high, 1.0):.2f} | {len(some)} | {right:.2f} |")
    return lines


def main() -> int:
    names = [name for name in os.environ.get("GENERATORS", "").split(",") if name] or list(NAMES)
    targets = int(os.environ.get("TARGETS") or 2)
    folder = Path(os.environ.get("OUT") or "out/fit")
    records = Lines(folder / "intervals.jsonl")
    done = {(row["generator"], row["target"], row["rough"]) for row in records.rows}
    for target in range(FIRST, FIRST + targets):
        for name in names:
            for rough in (0.0, ROUGH):
                if (name, target, rough) not in done:
                    records.add(answers_of(name, target, rough))
                    print(f"{name} {target} {rough}", flush=True)
    text = "\n".join(table(records.rows))
    (folder / "intervals.md").write_text(text + "\n")
    print(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
