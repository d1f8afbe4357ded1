"""Why a script cannot be repaired: which requirement stands against which."""

from __future__ import annotations

from collections.abc import Iterator

from niwaki.repairing.result import Conflict
from niwaki.repairing.search import Repairing, Trial
from niwaki.requirements.conflicts import SHOWN, against, rivals


def conflicts_of(search: Repairing) -> Iterator[Conflict]:
    """Return what is still violated in the best run, with what is violated in every run that keeps it."""
    for row in sorted(search.best.violations, key=lambda row: -row.amount)[:SHOWN]:
        words = row.title
        keeping = sorted(
            (trial for trial in search.sound if row.key not in trial.broken),
            key=lambda trial: (trial.violated, trial.number),
        )
        if keeping:
            opponents = rivals([_names(trial) for trial in keeping])
            yield Conflict(words, opponents, against(words, opponents, "runs"))
            continue
        yield Conflict(words, (), f"`{words}` is broken in every run: {_cause(search, row.parts)}")


def _names(trial: Trial) -> tuple[str, ...]:
    return tuple(row.title for row in sorted(trial.violations, key=lambda row: -row.amount))


def _cause(search: Repairing, parts: tuple[str, ...]) -> str:
    """Say which numbers could help, and why they do not change."""
    places = search.rules.places(parts)
    movers = [key for key, slope in search.slopes.items() if slope[places].any()]
    reasons = []
    if movers:
        rows = [search.rows[key] for key in movers]
        listed = ", ".join(f"line {row.line}: {row.text}" for row in rows[:SHOWN])
        reasons.append(f"the numbers that move it ({listed}) do not reach")
    if search.sizes:
        names = ", ".join(dict.fromkeys(row.name or f"line {row.line}" for row in search.sizes[:SHOWN]))
        reasons += ["no number moves it"] * (not movers)
        reasons.append(f"sizes stay as they are unless they are freed: {names}")
    return ", and ".join(reasons) or "no number of the script that may change moves it"
