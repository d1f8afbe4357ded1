"""The soft constraints that a run in plain Python meets."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.errors.source import Span


@dataclass(frozen=True)
class Constraint:
    """One soft constraint of a run.

    Attributes
    ----------
    kind : str
        "softeq", "soft_at_least" or "soft_at_most".
    address : str
        The calls and loops that led to it, then its kind.
    span : Span or None
        Its place in the source.
    value, goal : float
        What is compared with what.
    width : float
        Within which it should hold.
    """

    kind: str
    address: str
    span: Span | None
    value: float
    goal: float
    width: float

    @property
    def residual(self) -> float:
        """How far it is from holding, in its own units: signed for an equality, 0 or more for the others."""
        miss = self.value - self.goal
        if self.kind == "softeq":
            return miss
        return max(0.0, miss if self.kind == "soft_at_most" else -miss)

    @property
    def widths(self) -> float:
        """How far it is from holding, in widths; 0 or more."""
        return abs(self.residual) / self.width

    @property
    def line(self) -> str:
        """File and line, `tree.py:14`."""
        return f"{self.span.file.path}:{self.span.line}" if self.span is not None else ""
