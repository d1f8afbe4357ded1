"""Requirements that about one run in twenty keeps, as a filter alone and as a part of the score.

`python benches/requirements.py` grows three models with ten seeds each, as `niwaki grow` does: at most three searches
for each seed. No target has the height that is required: the house's is 2.5 high, the chair's 0.98, the coral's 11.
"""

from __future__ import annotations

import contextlib
import tempfile
import time
import warnings
from collections.abc import Callable
from pathlib import Path

import niwaki as nw
import numpy as np
from niwaki.shell import init, references, requirements, show
from niwaki.targets import asks
from niwaki.targets.sketches import volume_score

#: The heights that are required.
CASES = {"house": (3.2, 3.4), "chair": (1.25, 1.4), "coral": (9.6, 10.6)}
ROUNDS, SEEDS, RUNS = 3, 10, 100


def house() -> tuple[references.ModelReference, nw.Score]:
    """Return the model and the target of `niwaki init`."""
    folder = Path(tempfile.mkdtemp())
    with contextlib.redirect_stdout(None):
        init.init(folder)
    reference = references.find(str(folder / "house.py"))
    return reference, volume_score(folder / "target.obj")


def searches(
    reference: references.ModelReference, score: nw.Score, calls: list[int]
) -> Callable[[int, int], nw.Result]:
    """Return the searches for results with a score; each call is noted."""

    def attempt(seed: int, candidates: int) -> nw.Result:
        calls.append(seed)
        diverse = candidates if candidates > 1 else None
        return nw.grow(reference.model, score=score, rounds=ROUNDS, seed=seed, diverse=diverse)

    return attempt


def main() -> None:
    """Print the table."""
    warnings.simplefilter("ignore")
    print(
        "| model | height | runs that have it | score | kept | by the first search | searches | covered | s CPU |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for name, height in CASES.items():
        keep = nw.Keep(height=height)
        reference = references.find(name) if name != "house" else None
        if reference is None:
            reference, score = house()
        else:
            score = asks.score(reference.terms({}), volume_score)
        runs = show.prior_runs(reference.model, show.start(reference), RUNS, 1)
        share = np.mean([not keep.unmet(run) for run in runs])
        for title, goal in (("the target", score), ("and the height", keep.aims(score))):
            start, rows = time.process_time(), []
            for seed in range(1, SEEDS + 1):
                calls: list[int] = []
                result, _ = requirements.keeping(keep, searches(reference, goal, calls), seed, 1)
                rows.append((not keep.unmet(result.best), len(calls), result.best.fit.covered))
            kept, first = sum(row[0] for row in rows), sum(row[0] and row[1] == 1 for row in rows)
            covered = np.mean([row[2] for row in rows if row[0]] or [np.nan])
            print(
                f"| {name} | {height[0]:g} to {height[1]:g} | {share:.0%} | {title} | {kept} of {SEEDS} | {first} | "
                f"{sum(row[1] for row in rows)} | {covered:.0%} | {time.process_time() - start:.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
