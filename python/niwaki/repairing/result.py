"""Results of a repair: patches of the script, or the requirements that stand against one another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from niwaki.inputs.changes import Edit, FileChange
from niwaki.repairing.literals import Literal
from niwaki.repairing.writing import spelled
from niwaki.requirements import Violation


@dataclass(frozen=True)
class Patch(FileChange):
    """A change of a script that repairs it, or a part of it.

    Attributes
    ----------
    violations : tuple of Violation
        What is violated after it; empty if it repairs the script.
    moved : float
        How far the parts move, weighted by their volumes, as a share of the scene's size.
    numbers : int
        How many literals change.
    cost : float
        The cost by which patches are ordered: see `niwaki.repairing.search`.
    parts : tuple
        Name, vertices and faces of each part after it.
    """

    violations: tuple[Violation, ...]
    moved: float
    numbers: int
    cost: float
    parts: tuple[Any, ...] = ()

    @property
    def repairs(self) -> bool:
        """Whether nothing is violated after it."""
        return not self.violations

    def report(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {
            "difference": self.difference(),
            "edits": [{"line": edit.line, "before": edit.before, "after": edit.after} for edit in self.edits],
            "moved": self.moved,
            "violations": [list_of(row) for row in self.violations],
        }


@dataclass(frozen=True)
class Conflict:
    """A requirement that no patch keeps without breaking another.

    Attributes
    ----------
    requirement : str
        What is violated whatever changes, in words.
    against : tuple of str
        What is violated in its place in every run that keeps it; empty if no run keeps it.
    reason : str
        A sentence for people.
    """

    requirement: str
    against: tuple[str, ...]
    reason: str


@dataclass(frozen=True)
class Repair:
    """The result of `nw.repair`.

    Attributes
    ----------
    path : str
        The script.
    before : tuple of Violation
        What the script violates as it is written.
    patches : tuple of Patch
        Patches, the best first. If none repairs the script: the one that comes nearest, if it is better than nothing.
    conflicts : tuple of Conflict
        If no patch repairs it: what stands against what.
    evaluations : int
        How often the script was run.
    failures : dict
        How often runs failed, by text.
    interrupted : bool
        Whether Ctrl-C ended the search.
    parts : tuple
        Name, vertices and faces of each part as it is written.
    """

    path: str
    before: tuple[Violation, ...]
    patches: tuple[Patch, ...]
    conflicts: tuple[Conflict, ...]
    evaluations: int
    failures: dict[str, int]
    interrupted: bool = False
    parts: tuple[Any, ...] = ()

    @property
    def best(self) -> Patch | None:
        """The best patch; None without one."""
        return self.patches[0] if self.patches else None

    @property
    def repaired(self) -> bool:
        """Whether the script keeps everything as it is, or a patch repairs it."""
        return not self.before or bool(self.patches and self.patches[0].repairs)

    def report(self) -> dict[str, Any]:
        """Return it as JSON."""
        return {
            "file": self.path,
            "repaired": self.repaired,
            "violations": [list_of(row) for row in self.before],
            "patches": [patch.report() for patch in self.patches],
            "conflicts": [
                {"requirement": row.requirement, "against": list(row.against), "reason": row.reason}
                for row in self.conflicts
            ],
            "evaluations": self.evaluations,
            "failures": self.failures,
        }


def list_of(row: Violation) -> dict[str, Any]:
    """Return a violation as JSON."""
    return {"requirement": row.requirement, "parts": list(row.parts), "amount": row.amount}


def edits_of(text: str, rows: Sequence[Literal], values: dict[str, float]) -> tuple[Edit, ...]:
    """Return the edits of a text that give literals other values."""
    edits = []
    for row in rows:
        if row.key not in values or values[row.key] == row.value:
            continue
        new, operator = spelled(row, values[row.key])
        # A sign that turns is part of the edit.
        start = row.sign if operator and text[row.sign] != operator else row.start
        before = text[start : row.end]
        after = new if start == row.start else operator + text[start + 1 : row.start] + new
        line = text.count("\n", 0, start)
        column = start - (text.rfind("\n", 0, start) + 1) + 1
        edits.append(Edit(line + 1, column, column + len(before), before, after))
    return tuple(edits)
