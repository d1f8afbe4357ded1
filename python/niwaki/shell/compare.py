"""Comparison of two versions of a model: short searches of both into the same target.

Advice is about what usually helps; searches tell whether it helps this model. Both versions are searched with the same
settings and seeds. Each search is one vote, and `NEARLY_ALL` of the votes decide: with two models that are equally
good, one of them wins so often with probability 0.07.
"""

from __future__ import annotations

import warnings
from statistics import median

import niwaki as nw
from niwaki.search.warnings import SearchWarning
from niwaki.shell.progress import status_line
from niwaki.shell.references import ModelReference

SEARCHES, NEARLY_ALL = 8, 7


def compare(first: ModelReference, second: ModelReference, score: nw.Score) -> str:
    """Return a table of both models' searches, with the better model."""
    values: list[list[float]] = []
    lines = [f"{SEARCHES} searches of each, with the same seeds"]
    for reference in (first, second):
        with status_line(f"trying {reference.name}", keeps_best=False) as show:
            results = []
            for seed in range(SEARCHES):
                with warnings.catch_warnings():
                    # The table shows a version that does badly.
                    warnings.simplefilter("ignore", SearchWarning)
                    results.append(nw.grow(reference.model, score=score, seed=seed).to_its_end())
                show(f"search {seed + 1} of {SEARCHES}")
        best = [result.best.log_score for result in results]
        seconds = median(result.cpu_seconds for result in results)
        values.append(best)
        low, high = min(best), max(best)
        lines.append(
            f"  {reference.name}: median {median(best):.1f} ({low:.1f} to {high:.1f}), {seconds:.2f} s"
        )
    wins = sum(a > b for a, b in zip(*values, strict=True))
    losses = sum(a < b for a, b in zip(*values, strict=True))
    better = first if wins >= NEARLY_ALL else second if losses >= NEARLY_ALL else None
    count = max(wins, losses)
    if better is None:
        lines.append(f"no clear difference: {first.name} is better in {wins}, worse in {losses}")
    else:
        lines.append(f"{better.name} is better in {count} of {SEARCHES}")
    return "\n".join(lines)
