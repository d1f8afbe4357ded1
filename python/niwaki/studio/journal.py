"""A session on disk: a line for each step, on the disk before anything of it is shown.

    DIR/session.json     the session's name and the format, written whole
    DIR/journal.jsonl    one line for each step: {"step": n, "parent": m, "name": ..., "changes": {...}},
                         or a head that moved: {"head": n}, or a search that began or ended: {"running": n or null}
    DIR/runs/N.json      a search with its results (`niwaki replay` reads it)
    DIR/uploads/         meshes by the SHA-256 of what was sent
    DIR/files/           what was exported

Steps form a tree. Undo moves the head to the parent of a step, redo to the step that was left last. A last line that is
cut short (the process was killed while it wrote) is left out: nothing of it was shown.
"""

from __future__ import annotations

import json
import os
import secrets
from pathlib import Path
from typing import Any

import msgspec

from niwaki.errors import InputError
from niwaki.errors.files import write_whole
from niwaki.studio.document import Document

FORMAT = 1


class Journal:
    """The steps of a session.

    Attributes
    ----------
    folder : Path
    name : str
        Of the session; random.
    running : int or None
        The search that had begun and not ended when the journal was opened, then the one that runs.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for sub in ("runs", "uploads", "files"):
            (folder / sub).mkdir(parents=True, exist_ok=True)
        self.name = self._named()
        self.running: int | None = None
        self._parents: dict[int, int] = {}
        self._changes: dict[int, dict[str, Any]] = {}
        self._left: dict[int, int] = {}
        self._head = 0
        self._runs = 0
        path = folder / "journal.jsonl"
        self._read(path)
        self._file = open(path, "ab", buffering=0)  # noqa: SIM115

    def _named(self) -> str:
        place = self.folder / "session.json"
        if place.is_file():
            data = json.loads(place.read_text())
            if data.get("format") != FORMAT:
                reason = f"it has format {data.get('format')!r}, this version reads {FORMAT}"
                raise InputError("bad-run-file", path=place, reason=reason)
            return str(data["session"])
        name = secrets.token_hex(8)
        write_whole(place, json.dumps({"format": FORMAT, "session": name}).encode())
        return name

    def _read(self, path: Path) -> None:
        if not path.is_file():
            return
        data = path.read_bytes()
        whole = data[: data.rfind(b"\n") + 1]
        if len(whole) < len(data):
            os.truncate(path, len(whole))
        for number, line in enumerate(whole.splitlines(), 1):
            try:
                self._take(json.loads(line))
            except (ValueError, KeyError, TypeError) as error:
                raise InputError("bad-run-file", path=path, reason=f"line {number}: {error!r}") from error

    def _take(self, entry: dict[str, Any]) -> None:
        """Bring what is in memory up to date by one line."""
        if "step" in entry:
            step = entry["step"]
            self._parents[step], self._changes[step] = entry["parent"], entry["changes"]
            self._left[entry["parent"]] = self._head = step
        elif "head" in entry:
            self._head = entry["head"]
        else:
            self.running = entry["running"]
            self._runs = max(self._runs, (self.running or 0) + 1)

    def _write(self, entry: dict[str, Any]) -> None:
        self._file.write(json.dumps(entry, separators=(",", ":")).encode() + b"\n")
        os.fsync(self._file.fileno())
        self._take(entry)

    def step(self, name: str, changes: dict[str, Any]) -> None:
        """Do a step: other values of some fields of the document, as plain data."""
        number = len(self._parents) + 1
        self._write({"step": number, "parent": self._head, "name": name, "changes": changes})

    def run(self) -> int:
        """The number of a run that begins."""
        number = self._runs
        self._write({"running": number})
        return number

    def ended(self) -> None:
        """The search that ran has ended."""
        self._write({"running": None})

    def undo(self) -> bool:
        """Move the head one step back, if there is one."""
        if not self._head:
            return False
        self._write({"head": self._parents[self._head]})
        return True

    def redo(self) -> bool:
        """Move the head to the step that was left last, if there is one."""
        onward = self._left.get(self._head)
        if onward is None:
            return False
        self._write({"head": onward})
        return True

    @property
    def undoable(self) -> int:
        """How many steps can be taken back."""
        return len(self._line())

    @property
    def redoable(self) -> int:
        """How many steps can be taken again."""
        count, at = 0, self._head
        while at in self._left:
            count, at = count + 1, self._left[at]
        return count

    def _line(self) -> list[int]:
        """The steps from the first to the head."""
        found, at = [], self._head
        while at:
            found.append(at)
            at = self._parents[at]
        return found[::-1]

    def document(self) -> Document:
        """The document at the head."""
        changes: dict[str, Any] = {}
        for step in self._line():
            changes |= self._changes[step]
        try:
            return Document().changed(changes)
        except (msgspec.ValidationError, TypeError) as error:
            reason = f"a step of it is not one of this version: {error}"
            raise InputError("bad-run-file", path=self.folder / "journal.jsonl", reason=reason) from error

    def runs_file(self, number: int) -> Path:
        """The file of a run."""
        return self.folder / "runs" / f"{number}.json"

    def close(self) -> None:
        """Close the file."""
        self._file.close()
