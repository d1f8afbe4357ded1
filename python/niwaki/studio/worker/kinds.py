"""The module of a job: scenes, structures and drawings have a module each."""

from __future__ import annotations

from types import ModuleType

from niwaki.studio.messages import Question
from niwaki.studio.worker import coloring, jobs, models, runs, structures


def of_question(question: Question) -> ModuleType:
    """Return the module that shows a target, searches, changes choices, and grows parts again."""
    if coloring.is_drawing(question.model):
        return coloring
    return structures if models.is_structure(question.model) else jobs


def of_model(reference: str) -> ModuleType:
    """Return the module that shows a model of the list."""
    return coloring if coloring.is_drawing(reference) else jobs


def of_run(source: str) -> ModuleType:
    """Return the module that shows, describes and holds a result."""
    return coloring if coloring.is_coloring(source) else runs


def of_file(source: str, number: int) -> ModuleType:
    """Return the module that writes a result as a file."""
    if coloring.is_coloring(source):
        return coloring
    return structures if structures.is_structure(source, number) else runs
