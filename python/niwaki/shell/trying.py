"""Whether a change of a model is worth its while: short searches of both versions into the same target.

Advice is about what usually helps; whether it helps a model is a question to its searches. Both versions are searched
with the same settings and seeds. Each search is one vote, and `NEARLY_ALL` of the votes decide: of two models that are
equally good one wins so often with probability 0.07.
"""

from __future__ import annotations

import warnings
from statistics import median

import niwaki as nw
from niwaki.search.warnings import SearchWarning
from niwaki.shell.progress import said
from niwaki.shell.references import ModelReference

SEARCHES, NEARLY_ALL = 8, 7


def tried(first: ModelReference, second: ModelReference, score: nw.Score) -> str:
    """A table of both models' searches, and which is better."""
    values: list[list[float]] = []
    lines = [f"{SEARCHES} searches of each, with the same seeds"]
    for found in (first, second):
        with said(f"trying {found.reference}", keeps=False) as show:
            results = []
            for seed in range(SEARCHES):
                with warnings.catch_warnings():
                    # That a version is no good is what the table says.
                    warnings.simplefilter("ignore", SearchWarning)
                    results.append(nw.grow(found.model, score=score, seed=seed).to_its_end())
                show(f"search {seed + 1} of {SEARCHES}")
        best = [result.best.log_score for result in results]
        seconds = median(result.cpu_seconds for result in results)
        values.append(best)
        low, high = min(best), max(best)
        lines.append(
            f"  {found.reference}: median {median(best):.1f} ({low:.1f} to {high:.1f}), {seconds:.2f} s"
        )
    wins = sum(one > other for one, other in zip(*values, strict=True))
    losses = sum(one < other for one, other in zip(*values, strict=True))
    better = first if wins >= NEARLY_ALL else second if losses >= NEARLY_ALL else None
    count = max(wins, losses)
    if better is None:
        lines.append(f"no clear difference: {first.reference} is better in {wins}, worse in {losses}")
    else:
        lines.append(f"{better.reference} is better in {count} of {SEARCHES}")
    return "\n".join(lines)
