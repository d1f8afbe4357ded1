"""Changes of a user's file: edits with their difference, shown before the file is written, and written whole."""

from __future__ import annotations

import difflib
from dataclasses import dataclass
from pathlib import Path

from niwaki.errors import InputError
from niwaki.errors.files import write_whole


@dataclass(frozen=True)
class Edit:
    """Edit of a piece of a line; line and columns from 1, the end excluded."""

    line: int
    column: int
    end_column: int
    before: str
    after: str


@dataclass(frozen=True)
class FileChange:
    """Change of a user's file.

    Attributes
    ----------
    path : str
        The file.
    edits : tuple of Edit
        The edits of the file.
    text : str
        The text for which they were computed.
    """

    path: str
    edits: tuple[Edit, ...]
    text: str

    @property
    def description(self) -> str:
        """Description of the change, in a few words."""
        return "; ".join(f"line {edit.line}: {edit.before} becomes {edit.after}" for edit in self.edits)

    @property
    def changed(self) -> str:
        """The text of the file with the change."""
        lines = self.text.split("\n")
        for edit in sorted(self.edits, key=lambda edit: (edit.line, -edit.column)):
            line = lines[edit.line - 1]
            lines[edit.line - 1] = line[: edit.column - 1] + edit.after + line[edit.end_column - 1 :]
        return "\n".join(lines)

    def difference(self) -> str:
        """The change as a unified difference."""
        name = Path(self.path).name
        before, after = (text.splitlines(keepends=True) for text in (self.text, self.changed))
        return "".join(difflib.unified_diff(before, after, fromfile=name, tofile=name, n=1))

    def apply(self) -> None:
        """Write the file, completely or not at all.

        Raises
        ------
        InputError
            `edited-meanwhile`: the file has changed since this change was computed.
        """
        place = Path(self.path)
        if not place.is_file() or place.read_bytes() != self.text.encode():
            raise InputError("edited-meanwhile", path=self.path)
        write_whole(place, self.changed.encode())
