"""Errors of libraries that read files, as errors of the package.

Libraries raise errors of every type: about values, types, recursion, memory. Only calls of a library belong under this
guard, so that a mistake of the package is never reported as a bad file.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike

from niwaki.errors import FileError, NiwakiError
from niwaki.inputs.limits import beyond

#: The most characters of a library's message in an error.
SHOWN = 300


@contextmanager
def library(place: str | PathLike[str] | None, kind: str) -> Iterator[None]:
    """Turn the errors of a library into a `FileError` about the file, with the library's error as its cause.

    Parameters
    ----------
    place
        The file.
    kind
        The expected kind of file: ".stl", "an image".

    Raises
    ------
    FileError
        `file-unreadable`; `file-limit`: memory ran out.
    """
    try:
        yield
    except NiwakiError:
        raise
    except MemoryError as error:
        raise beyond("memory", "reading it takes more memory than is free", place) from error
    except Exception as error:
        raise FileError("file-unreadable", place, suffix=kind, reason=reason_of(error)) from error
    except BaseException as error:
        # A panic of a library in Rust is not an `Exception`.
        if type(error).__name__ != "PanicException":
            raise
        raise FileError("file-unreadable", place, suffix=kind, reason=reason_of(error)) from error


def reason_of(error: BaseException) -> str:
    """Return an error's message in one line."""
    if isinstance(error, ModuleNotFoundError):
        return f"its contents need the package `{error.name}`, which is not installed"
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    text = "".join(character if character.isprintable() else " " for character in str(error)[: 4 * SHOWN])
    text = " ".join(text.split())
    return (text if len(text) <= SHOWN else text[:SHOWN] + " ...") or type(error).__name__
