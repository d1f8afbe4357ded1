"""Errors about files that come in or go out: one table of messages, one class.

A message has a code, a title, the file it is about, the reason and the cure.
"""

from __future__ import annotations

from os import PathLike
from typing import Any

from niwaki.errors import NiwakiError

#: code: (title, why, help); the names in braces are filled in where the error is raised.
FILE_MESSAGES: dict[str, tuple[str, str, str]] = {
    "file-missing": (
        "there is no file at this path",
        "nothing was found at {absolute}",
        "check the spelling, or give the path from the folder you are in: {folder}",
    ),
    "file-format": (
        "`{suffix}` is not a format that can be {done} here",
        "the format is chosen by the end of the file's name",
        "use one of {formats}",
    ),
    "file-unreadable": (
        "this file cannot be read as {suffix}",
        "{reason}",
        "open it in the program that made it and export it again; a broken download is cut short",
    ),
    "target-empty": (
        "this target has no triangles",
        "{reason}",
        "export a mesh with faces; points and curves alone have no volume to fill",
    ),
    "target-not-finite": (
        "this target has coordinates that are not finite numbers",
        "{count} of {total} vertices hold nan or inf, the first is number {first}",
        "clean the mesh in the program that made it; often a modifier divided by zero",
    ),
    "target-flat": (
        "this target has no thickness along {axis}",
        "its extent is {extent}",
        "give it a volume, such as by thickening or extruding it",
    ),
    "setting": (
        "`{name}` cannot be {found!r}",
        "found {found!r}, expected {expected}",
        "choose one of these",
    ),
    "scene-empty": (
        "there is nothing to {verb}",
        "the scene has no parts",
        "let the model `emit` at least one shape",
    ),
    "file-unwritable": (
        "this file cannot be written",
        "{reason}",
        "check that the folder exists, that you may write there and that the disk has room",
    ),
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

    def __str__(self) -> str:
        """Return the whole message."""
        return self.render()
