"""Soft constraints of a run in plain Python."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.errors.source import Span


@dataclass(frozen=True)
class Constraint:
    """A soft constraint of a run.

    Attributes
    ----------
    kind : str
        "softeq", "soft_at_least" or "soft_at_most".
    address : str
        The calls and loops that lead to the constraint, then its kind.
    span : Span or None
        The place in the source.
    value, goal : float
        The value, and the number with which it is compared.
    width : float
        The tolerance of the constraint.
    """

    kind: str
    address: str
    span: Span | None
    value: float
    goal: float
    width: float

    @property
    def residual(self) -> float:
        """Distance from holding, in the value's units: signed for an equality, else 0 or more."""
        miss = self.value - self.goal
        if self.kind == "softeq":
            return miss
        return max(0.0, miss if self.kind == "soft_at_most" else -miss)

    @property
    def widths(self) -> float:
        """Distance from holding, in widths; 0 or more."""
        return abs(self.residual) / self.width

    @property
    def line(self) -> str:
        """The file and the line, such as `tree.py:14`."""
        return f"{self.span.file.path}:{self.span.line}" if self.span is not None else ""
