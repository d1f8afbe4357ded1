"""Files that are read or written, and the errors about them; their texts are in `niwaki.errors.texts.files`.

A message has a code, a title, the file it is about, the reason and the cure.
"""

from __future__ import annotations

import os
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.errors.kinds import NiwakiError
from niwaki.errors.texts.files import FILES

#: code: (title, why, help); the names in braces are filled in where the error is raised.
FILE_MESSAGES: dict[str, tuple[str, str, str]] = {
    message.code: (message.title, message.why, message.help) for message in FILES
}


class FileError(NiwakiError):
    """A file cannot be used.

    Parameters
    ----------
    code
        A code of `FILE_MESSAGES`.
    place
        The file, if there is one.
    values
        What the message's templates name.

    Examples
    --------
    >>> print(FileError("scene-empty", verb="draw"))
    error[scene-empty]: there is nothing to draw
     = why: the scene has no parts
     = help: let the model `emit` at least one shape
    """

    def __init__(self, code: str, place: str | PathLike[str] | None = None, **values: Any) -> None:
        super().__init__(code)
        self.code = code
        self.place = place
        self.values = values

    def render(self) -> str:
        """Return the whole message: title, file, reason, cure."""
        title, why, cure = (text.format_map(self.values) for text in FILE_MESSAGES[self.code])
        lines = [f"error[{self.code}]: {title}"]
        if self.place is not None:
            lines.append(f"  --> {self.place}")
        return "\n".join([*lines, f" = why: {why}", f" = help: {cure}"])


def existing(path: str | PathLike[str]) -> Path:
    """The path of a file that is there; an error where it is not."""
    place = Path(path)
    if not place.is_file():
        raise FileError("file-missing", path, absolute=place.absolute(), folder=Path.cwd())
    return place


def write_whole(place: Path, data: bytes) -> Path:
    """Write bytes under a temporary name beside the file, then rename: readers see all of it or nothing."""
    temporary = place.with_name(f".{place.name}.{os.getpid()}.part")
    try:
        temporary.write_bytes(data)
        os.replace(temporary, place)
    except OSError as error:
        raise FileError("file-unwritable", place, reason=error.strerror or str(error)) from error
    finally:
        temporary.unlink(missing_ok=True)
    return place
