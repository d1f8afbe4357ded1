"""Errors as the messages that a window shows."""

from __future__ import annotations

import sys
import traceback

from niwaki.errors import NiwakiError
from niwaki.errors.source import Span
from niwaki.studio.messages import Place, Problem


class CommandError(Exception):
    """A command that cannot be carried out, with the message for its window."""

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.problem = Problem(code, text)


def problem(error: BaseException) -> Problem:
    """Describe an error for the page: the shell's text, and its place in a source file if it has one.

    An error of the system keeps the system's words. An unexpected error is also written to the terminal, for a report.
    """
    if isinstance(error, CommandError):
        return error.problem
    if isinstance(error, OSError) and error.strerror:
        where = "" if error.filename is None else f": {error.filename}"
        return Problem("system", f"the system reports an error: {error.strerror}{where}")
    if not isinstance(error, NiwakiError):
        traceback.print_exception(error, file=sys.stderr)
        return Problem("failed", f"{type(error).__name__}: {error}")
    span = getattr(error, "span", None)
    stack = getattr(error, "stack", ())
    if span is None and stack:
        span = stack[-1].span
    return Problem(error.code, str(error), placed(span))


def placed(span: Span | None) -> Place | None:
    """Convert a span to plain data."""
    if span is None:
        return None
    return Place(span.file.path, span.line, span.column, span.end_line, span.end_column)
