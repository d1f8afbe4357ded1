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


def summary(rows: Rows) -> dict[str, Any]:
    """Median, worst, those far behind, dead, complete and mean CPU seconds of searches of a problem."""
    median = statistics.median(map(score, rows))
    return {
        "searches": len(rows),
        "median": median,
        "behind": sum(score(row) < median - BEHIND for row in rows),
        "worst": min(map(score, rows)),
        "dead": sum(row["score"] is None for row in rows),
        "complete": sum(is_complete(row) for row in rows),
        "cpu": statistics.fmean(row["cpu"] for row in rows),
    }


def interval(strata: Sequence[Sequence[float]]) -> tuple[float, float, float]:
    """Mean over the strata of the means of differences, with its bootstrap 95 % interval.

    Differences are drawn again within each stratum (percentile bootstrap).
    """
    random = np.random.default_rng(SEED)
    drawn = [
        np.asarray(stratum)[random.integers(len(stratum), size=(DRAWS, len(stratum)))].mean(axis=1)
        for stratum in strata
    ]
    low, high = np.percentile(np.mean(drawn, axis=0), (2.5, 97.5))
    return float(np.mean([np.mean(stratum) for stratum in strata])), float(low), float(high)


def pairs(
    ours: dict[int, dict[str, Any]], theirs: dict[int, dict[str, Any]]
) -> list[tuple[dict[str, Any], dict[str, Any]]]:
    """Searches with the same seed on both sides."""
    return [(ours[seed], theirs[seed]) for seed in sorted(ours.keys() & theirs.keys())]


def gains(both_rows: list[tuple[dict[str, Any], dict[str, Any]]]) -> tuple[list[float], list[float]]:
    """Differences of pairs: log scores in nats, and complete or not (1, 0 or -1)."""
    scores = [score(a) - score(b) for a, b in both_rows]
    complete = [float(is_complete(a)) - is_complete(b) for a, b in both_rows]
    return scores, complete


def defaults(rows: Rows, method: str = "default") -> list[str]:
    """One method on each problem, in full."""
    lines = [
        "| problem | kind | CPU s | median | worst | 15 behind | empty scene | dead | complete |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for case in PROBLEMS:
        results = list(of(rows, case.name, method).values())
        if results:
            s = summary(results)
            empty = statistics.median(row["empty"] for row in results)
            complete = f"{s['complete']} of {s['searches']}"
            lines.append(
                f"| {case.name} | {case.kind}{', made' if case.is_made else ''} | {s['cpu']:.2f} | {s['median']:.1f} "
                f"| {s['worst']:.1f} | {s['behind']} | {empty:.0f} | {s['dead']} | {complete} |"
            )
    return lines


def methods(rows: Rows, names: Sequence[str]) -> list[str]:
    """Medians of all methods, with the share that is complete, and how many died."""
    lines = ["| problem | " + " | ".join(names) + " |", "| --- " * (len(names) + 1) + "|"]
    for case in PROBLEMS:
        cells = []
        for name in names:
            results = list(of(rows, case.name, name).values())
            if not results:
                cells.append("")
                continue
            s = summary(results)
            died = f", {s['dead']} dead" if s["dead"] else ""
            cells.append(
                f"{s['median']:.1f} / {s['worst']:.0f}, {100 * s['complete'] / s['searches']:.0f} %{died}"
            )
        if any(cells):
            lines.append(f"| {case.name} | " + " | ".join(cells) + " |")
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
        by_case = {
            case: both
            for case in PROBLEMS
            if (both := pairs(of(rows, case.name, name), of(base_rows, case.name, base or name)))
        }
        if not by_case:
            continue
        gained = {case: gains(both) for case, both in by_case.items()}
        ends = [interval([scores])[1:] for scores, _ in gained.values()]
        better, worse = sum(low > 0.0 for low, _ in ends), sum(high < 0.0 for _, high in ends)
        share = statistics.fmean(
            statistics.fmean(is_complete(a) for a, _ in both) for both in by_case.values()
        )
        spent = statistics.median(
            sum(a["cpu"] for a, _ in both) / sum(b["cpu"] for _, b in both) for both in by_case.values()
        )
        all_of_them = percent([complete for _, complete in gained.values()])
        of_made = percent([complete for case, (_, complete) in gained.items() if case.is_made])
        lines.append(
            f"| {name} | {base or 'before'} | {sum(map(len, by_case.values()))} | {100 * share:.0f} % | {all_of_them} "
            f"| {of_made} | {better} of {len(by_case)} | {worse} | {spent:.2f} |"
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
    for case in PROBLEMS:
        results = pairs(of(rows, case.name, name), of(base_rows, case.name, base))
        if results:
            scores, complete = gains(results)
            mean, low, high = interval([scores])
            lines.append(
                f"| {case.name} | {len(results)} | {mean:+.1f} ({low:+.1f} to {high:+.1f}) "
                f"| {sum(complete):+.0f} of {len(results)} |"
            )
    return lines
