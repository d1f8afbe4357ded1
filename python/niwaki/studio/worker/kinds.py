"""Which module does a job: scenes, structures and drawings are worked on in ways of their own."""

from __future__ import annotations

from types import ModuleType

from niwaki.studio.messages import Question
from niwaki.studio.worker import coloring, jobs, models, runs, structures


def asked(question: Question) -> ModuleType:
    """What shows a target, searches, changes choices, and grows parts again."""
    if coloring.is_drawing(question.model):
        return coloring
    return structures if models.is_structure(question.model) else jobs


def stored(source: str) -> ModuleType:
    """What shows, describes and holds a result."""
    return coloring if coloring.is_coloring(source) else runs


def written(source: str, number: int) -> ModuleType:
    """What writes a result as a file."""
    if coloring.is_coloring(source):
        return coloring
    return structures if structures.is_structure(source, number) else runs
