"""Violations and requirements as values, for people and as JSON."""

from __future__ import annotations

from dataclasses import dataclass

from msgspec import Struct


@dataclass(frozen=True)
class Violation:
    """A requirement that is violated.

    Attributes
    ----------
    requirement : str
        The requirement.
    parts : tuple of str
        The parts that violate it; of two parts, the one that asks for something comes first. Empty: all together.
    amount : float
        How far: above 0, in one unit for all violations of a goal.
    """

    requirement: str
    parts: tuple[str, ...]
    amount: float

    @property
    def key(self) -> tuple[str, tuple[str, ...]]:
        """The requirement and the parts."""
        return self.requirement, self.parts

    @property
    def title(self) -> str:
        """The requirement and the parts in words: `collisions (bed, wardrobe)`."""
        return f"{self.requirement} ({', '.join(self.parts)})" if self.parts else self.requirement

    def __str__(self) -> str:
        """Return it in words: `collisions: bed, wardrobe (0.1)`."""
        about = f": {', '.join(self.parts)}" if self.parts else ""
        return f"{self.requirement}{about} ({self.amount:.3g})"


class RequirementRow(Struct):
    """A requirement beside a model.

    Attributes
    ----------
    name, text
        Its key in the file, and the requirement in words.
    holds
        Whether the judged run keeps it; None where no run was judged.
    value
        The value of the judged run, in words.
    """

    name: str
    text: str
    holds: bool | None = None
    value: str = ""
