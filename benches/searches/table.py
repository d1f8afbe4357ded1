"""The tables of the manual, and paired differences by seed with a bootstrap interval.

A search that died counts with the score of the empty scene, which is what its user has. `complete` is the share of
searches that a person would call complete: `complete.is_complete`.
"""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from typing import Any

import numpy as np

from searches.complete import is_complete
from searches.problems import PROBLEMS

Rows = Sequence[dict[str, Any]]

#: A search whose score is so many nats below the median counts as lost.
BEHIND = 15.0
#: Draws of the bootstrap, and its seed.
DRAWS, SEED = 10_000, 1


def score(row: dict[str, Any]) -> float:
    """The log score of a search, nats."""
    return float(row["empty"] if row["score"] is None else row["score"])


def of(rows: Rows, problem: str, method: str) -> dict[int, dict[str, Any]]:
    """The searches of a problem by a method, by seed; the newest where there are several."""
    return {row["seed"]: row for row in rows if (row["problem"], row["method"]) == (problem, method)}


def summary(found: Rows) -> dict[str, Any]:
    """Median, worst, those far behind, dead, complete and mean CPU seconds of searches of a problem."""
    median = statistics.median(map(score, found))
    return {
        "searches": len(found),
        "median": median,
        "behind": sum(score(row) < median - BEHIND for row in found),
        "worst": min(map(score, found)),
        "dead": sum(row["score"] is None for row in found),
        "complete": sum(is_complete(row) for row in found),
        "cpu": statistics.fmean(row["cpu"] for row in found),
    }


def interval(strata: Sequence[Sequence[float]]) -> tuple[float, float, float]:
    """Mean over the strata of the means of differences, with its bootstrap 95 % interval.

    Differences are drawn again within each stratum (percentile bootstrap).
    """
    random = np.random.default_rng(SEED)
    drawn = [
        np.asarray(one)[random.integers(len(one), size=(DRAWS, len(one)))].mean(axis=1) for one in strata
    ]
    low, high = np.percentile(np.mean(drawn, axis=0), (2.5, 97.5))
    return float(np.mean([np.mean(one) for one in strata])), float(low), float(high)


def pairs(
    ours: dict[int, dict[str, Any]], others: dict[int, dict[str, Any]]
) -> list[tuple[dict[str, Any], dict[str, Any]]]:
    """Searches with the same seed on both sides."""
    return [(ours[seed], others[seed]) for seed in sorted(ours.keys() & others.keys())]


def gains(found: list[tuple[dict[str, Any], dict[str, Any]]]) -> tuple[list[float], list[float]]:
    """Differences of pairs: log scores in nats, and complete or not (1, 0 or -1)."""
    scores = [score(a) - score(b) for a, b in found]
    complete = [float(is_complete(a)) - is_complete(b) for a, b in found]
    return scores, complete


def defaults(rows: Rows, method: str = "default") -> list[str]:
    """One method on each problem, in full."""
    lines = [
        "| problem | kind | CPU s | median | worst | 15 behind | empty scene | dead | complete |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for one in PROBLEMS:
        found = list(of(rows, one.name, method).values())
        if found:
            s = summary(found)
            nothing = statistics.median(row["empty"] for row in found)
            complete = f"{s['complete']} of {s['searches']}"
            lines.append(
                f"| {one.name} | {one.kind}{', made' if one.is_made else ''} | {s['cpu']:.2f} | {s['median']:.1f} "
                f"| {s['worst']:.1f} | {s['behind']} | {nothing:.0f} | {s['dead']} | {complete} |"
            )
    return lines


def methods(rows: Rows, names: Sequence[str]) -> list[str]:
    """Medians of all methods, with the share that is complete, and how many died."""
    lines = ["| problem | " + " | ".join(names) + " |", "| --- " * (len(names) + 1) + "|"]
    for one in PROBLEMS:
        cells = []
        for name in names:
            found = list(of(rows, one.name, name).values())
            if not found:
                cells.append("")
                continue
            s = summary(found)
            died = f", {s['dead']} dead" if s["dead"] else ""
            cells.append(
                f"{s['median']:.1f} / {s['worst']:.0f}, {100 * s['complete'] / s['searches']:.0f} %{died}"
            )
        if any(cells):
            lines.append(f"| {one.name} | " + " | ".join(cells) + " |")
    return lines


def against(rows: Rows, names: Sequence[str], base_rows: Rows, base: str | None = None) -> list[str]:
    """Each method over all problems, less `base`, or less itself in `base_rows`, by seed.

    Better and worse are problems where the interval of the difference of log scores excludes zero; of the ratios of CPU
    seconds, one for each problem, the median is given.
    """
    lines = [
        "| method | less | pairs | complete | gain in complete | on made targets | better on | worse on | CPU, times |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name in names:
        found = {
            one: both
            for one in PROBLEMS
            if (both := pairs(of(rows, one.name, name), of(base_rows, one.name, base or name)))
        }
        if not found:
            continue
        gained = {one: gains(both) for one, both in found.items()}
        ends = [interval([scores])[1:] for scores, _ in gained.values()]
        better, worse = sum(low > 0.0 for low, _ in ends), sum(high < 0.0 for _, high in ends)
        share = statistics.fmean(statistics.fmean(is_complete(a) for a, _ in both) for both in found.values())
        spent = statistics.median(
            sum(a["cpu"] for a, _ in both) / sum(b["cpu"] for _, b in both) for both in found.values()
        )
        all_of_them = percent([complete for _, complete in gained.values()])
        of_made = percent([complete for one, (_, complete) in gained.items() if one.is_made])
        lines.append(
            f"| {name} | {base or 'before'} | {sum(map(len, found.values()))} | {100 * share:.0f} % | {all_of_them} "
            f"| {of_made} | {better} of {len(found)} | {worse} | {spent:.2f} |"
        )
    return lines


def percent(strata: Sequence[Sequence[float]]) -> str:
    """A mean difference of shares with its interval, in percent; empty without any."""
    if not strata:
        return ""
    mean, low, high = (100 * share for share in interval(strata))
    return f"{mean:+.0f} % ({low:+.0f} to {high:+.0f})"


def by_problem(rows: Rows, name: str, base_rows: Rows, base: str) -> list[str]:
    """One method less another on each problem, by seed."""
    lines = [
        f"| problem | pairs | {name} less {base}: log score, 95 % | complete |",
        "| --- | --- | --- | --- |",
    ]
    for one in PROBLEMS:
        found = pairs(of(rows, one.name, name), of(base_rows, one.name, base))
        if found:
            scores, complete = gains(found)
            mean, low, high = interval([scores])
            lines.append(
                f"| {one.name} | {len(found)} | {mean:+.1f} ({low:+.1f} to {high:+.1f}) "
                f"| {sum(complete):+.0f} of {len(found)} |"
            )
    return lines
