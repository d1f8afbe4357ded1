"""Errors as the messages that a window shows."""

from __future__ import annotations

import sys
import sysconfig
import traceback
from pathlib import Path

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
    return Problem(error.code, str(error), placed(span) or _of_cause(error.__cause__))


def _of_cause(cause: BaseException | None) -> Place | None:
    """Return the place in the file whose code raised an exception, or which Python cannot read."""
    if isinstance(cause, SyntaxError) and cause.filename and cause.lineno:
        column = cause.offset or 1
        return Place(cause.filename, cause.lineno, column, cause.end_lineno or cause.lineno, column + 1)
    frames = traceback.extract_tb(None if cause is None else cause.__traceback__)
    # The line of the user's file comes after those that ran it; library code that it calls comes last.
    users = [frame for frame in frames if frame.lineno and not _is_library(frame.filename)]
    if not users or users[-1].lineno is None:
        return None
    line = users[-1].lineno
    return Place(users[-1].filename, line, 1, line, 1)


def _is_library(path: str) -> bool:
    """Whether a file is of this package, of another package, or of Python itself."""
    homes = (str(Path(__file__).parents[1]), *sysconfig.get_paths().values())
    return path.startswith(("<", *homes))


def placed(span: Span | None) -> Place | None:
    """Convert a span to plain data."""
    if span is None:
        return None
    return Place(span.file.path, span.line, span.column, span.end_line, span.end_column)
