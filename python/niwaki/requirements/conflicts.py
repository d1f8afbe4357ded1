"""Requirements that stand against one another: what results that keep the one violate in its place."""

from __future__ import annotations

from collections.abc import Sequence

#: Names that a sentence lists.
SHOWN = 3


def rivals(keeping: Sequence[Sequence[str]]) -> tuple[str, ...]:
    """Return what all results that keep a requirement violate; else what the nearest of them violate most.

    Parameters
    ----------
    keeping
        What each result that keeps the requirement violates, the worst first; the nearest result comes first.
    """
    if not keeping:
        return ()
    in_all = tuple(name for name in keeping[0] if all(name in row for row in keeping))
    return in_all or tuple(dict.fromkeys(row[0] for row in keeping if row))[:SHOWN]


def against(requirement: str, opponents: Sequence[str], things: str) -> str:
    """Return the sentence about a requirement and what stands against it."""
    listed = " or ".join(f"`{name}`" for name in opponents[:SHOWN])
    return f"`{requirement}` stands against {listed}: {things} that keep the one break the other"
