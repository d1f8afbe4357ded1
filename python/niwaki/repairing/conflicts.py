"""Why a script cannot be repaired: which requirement stands against which."""

from __future__ import annotations

from collections.abc import Iterator

from niwaki.repairing.result import Conflict
from niwaki.repairing.search import Repairing, Trial

#: Names that a sentence lists.
SHOWN = 3


def conflicts_of(search: Repairing) -> Iterator[Conflict]:
    """Return what is still violated in the best run, with what is violated in every run that keeps it."""
    for row in sorted(search.best.violations, key=lambda row: -row.amount)[:SHOWN]:
        words = row.title
        keeping = [trial for trial in search.sound if row.key not in trial.broken]
        if keeping:
            rivals = _in_all(keeping) or _nearest(keeping)
            listed = " or ".join(rivals[:SHOWN])
            yield Conflict(
                words, rivals, f"{words} stands against {listed}: runs that keep the one break the other"
            )
            continue
        yield Conflict(words, (), f"{words} is broken in every run: {_cause(search, row.parts)}")


def _names(trial: Trial) -> tuple[str, ...]:
    return tuple(row.title for row in sorted(trial.violations, key=lambda row: -row.amount))


def _in_all(trials: list[Trial]) -> tuple[str, ...]:
    """Return what is violated in all runs."""
    names = _names(trials[0])
    for trial in trials[1:]:
        kept = set(_names(trial))
        names = tuple(name for name in names if name in kept)
    return names


def _nearest(trials: list[Trial]) -> tuple[str, ...]:
    """Return what the runs in which least is violated violate most: one thing of each."""
    ordered = sorted(trials, key=lambda trial: (trial.violated, trial.number))
    return tuple(dict.fromkeys(_names(trial)[0] for trial in ordered))[:SHOWN]


def _cause(search: Repairing, parts: tuple[str, ...]) -> str:
    """Say which numbers could help, and why they do not change."""
    places = [search.rules.index[name] for name in parts if name in search.rules.index]
    movers = [key for key, slope in search.slopes.items() if slope[places].any()]
    if movers:
        rows = [search.rows[key] for key in movers]
        listed = ", ".join(f"line {row.line}: {row.text}" for row in rows[:SHOWN])
        return f"the numbers that move it ({listed}) do not reach"
    if search.sizes:
        names = ", ".join(dict.fromkeys(row.name or f"line {row.line}" for row in search.sizes[:SHOWN]))
        return f"no number moves it, and sizes stay as they are unless they are freed: {names}"
    return "no number of the script that may change moves it"
