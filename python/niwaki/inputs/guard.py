"""The errors of a library that reads a file, as ours.

Readers raise errors of every type: of values, of types, of recursion, of memory. Only a call of a library belongs under
this guard, so that no mistake of our own is taken for a bad file.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike

from niwaki.errors import FileError, NiwakiError
from niwaki.inputs.limits import beyond

#: Characters of a library's message that are shown.
SHOWN = 300


@contextmanager
def library(place: str | PathLike[str] | None, what: str) -> Iterator[None]:
    """Turn what a library raises into a `FileError` about the file, with the library's own error as its cause.

    Parameters
    ----------
    place
        The file.
    what
        What it should be: ".stl", "an image".

    Raises
    ------
    FileError
        `file-unreadable`, or `file-limit` where memory was short.
    """
    try:
        yield
    except NiwakiError:
        raise
    except MemoryError as error:
        raise beyond("memory", "reading it takes more memory than there is", place) from error
    except Exception as error:
        raise FileError("file-unreadable", place, suffix=what, reason=reason_of(error)) from error
    except BaseException as error:
        # What a library in Rust raises when it fails: no `Exception`, so that Python programs end.
        if type(error).__name__ != "PanicException":
            raise
        raise FileError("file-unreadable", place, suffix=what, reason=reason_of(error)) from error


def reason_of(error: BaseException) -> str:
    """What an error says, in one line."""
    if isinstance(error, ModuleNotFoundError):
        return f"its contents need the package `{error.name}`, which is not installed"
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    said = "".join(one if one.isprintable() else " " for one in str(error)[: 4 * SHOWN])
    said = " ".join(said.split())
    return (said if len(said) <= SHOWN else said[:SHOWN] + " ...") or type(error).__name__
