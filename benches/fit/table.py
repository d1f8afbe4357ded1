"""Medians of what searches found, as tables of Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from statistics import median
from typing import Any

from .problems import MARKS

Row = dict[str, Any]


def distinct(rows: Iterable[Row]) -> list[Row]:
    """Leave out a search that was done again with a larger budget, as far as both have been judged."""
    names = ("search", "generator", "target", "seed", "evaluations")
    out: dict[tuple[Any, ...], Row] = {}
    for row in sorted(rows, key=lambda row: int(row["budget"])):
        out.setdefault(tuple(row[name] for name in names), row)
    return list(out.values())


def by_search(rows: Sequence[Row]) -> list[str]:
    """A line for each search: medians of all problems, and how many are solved in its median seed."""
    lines = [
        "| search | evaluations | seeds | score | IoU | solved | switches | error | overhead, ms |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name in dict.fromkeys(row["search"] for row in rows):
        for mark in MARKS:
            rows_here = [row for row in rows if row["search"] == name and row["evaluations"] == mark]
            if not rows_here:
                continue
            problems = len({(row["generator"], row["target"]) for row in rows_here})
            seeds = sorted({row["seed"] for row in rows_here})
            solved = median(
                [sum(row["solved"] for row in rows_here if row["seed"] == seed) for seed in seeds]
            )
            lines.append(
                f"| {name} | {mark} | {len(seeds)} | {_middle(rows_here, 'score'):.2f} | "
                f"{_middle(rows_here, 'iou'):.2f} | {solved:g} of {problems} | "
                f"{_mean(rows_here, 'switches')} | {_mean(rows_here, 'error')} | "
                f"{_middle(rows_here, 'overhead'):.1f} |"
            )
    return lines


def by_problem(rows: Sequence[Row], mark: int) -> list[str]:
    """A line for each problem: the median score of each search, and that of the hidden parameters."""
    searches = list(dict.fromkeys(row["search"] for row in rows))
    lines = ["| problem | hidden | " + " | ".join(searches) + " |", "| --- " * (len(searches) + 2) + "|"]
    at = [row for row in rows if row["evaluations"] == mark]
    for key in dict.fromkeys((row["generator"], row["target"]) for row in at):
        here = [row for row in at if (row["generator"], row["target"]) == key]
        cells = []
        for name in searches:
            scores = [row["score"] for row in here if row["search"] == name]
            cells.append(f"{median(scores):.2f}" if scores else "")
        lines.append(f"| {key[0]} {key[1]} | {here[0]['truth']:.2f} | " + " | ".join(cells) + " |")
    return lines


def _middle(rows: Iterable[Row], name: str) -> float:
    return float(median([row[name] for row in rows]))


def _mean(rows: Iterable[Row], name: str) -> str:
    values = [row[name] for row in rows if row[name] is not None]
    return f"{100 * sum(values) / len(values):.0f} %" if values else ""
