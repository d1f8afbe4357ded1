"""A session on disk: a line for each step, written before any window shows the step.

    DIR/session.json     the session's name and the format, written whole
    DIR/journal.jsonl    one line for each step: {"step": n, "parent": m, "name": ..., "changes": {...}},
                         or a head that moved: {"head": n}, or a search that began or ended: {"running": n or null}
    DIR/runs/N.json      a search with its results (`niwaki replay` reads it)
    DIR/uploads/         uploaded meshes by the SHA-256 of their bytes
    DIR/files/           exported files
    DIR/journal.damaged  a copy of the journal, if its last line was damaged

Steps form a tree and are numbered from 1 in the order in which they were done. Undo moves the head to the parent of a
step, redo to the step that was left last.

Each line is written completely or not at all: if writing fails, the file is cut back and the step is not done. A last
line that is cut short (the process was killed while it wrote) or damaged is left out. All files of a session lie in its
folder: no link leads out of it.
"""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta, Struct

from niwaki.errors import InputError
from niwaki.errors.files import unwritable, write_all, write_whole
from niwaki.errors.schema import Unfit, decoded, fitted
from niwaki.inputs import bytes_of, limit
from niwaki.inputs.limits import beyond
from niwaki.studio.document import Document
from niwaki.studio.messages.document import Number
from niwaki.studio.problems import CommandError

FORMAT = 1

#: Folders inside the folder of a session.
FOLDERS = ("runs", "uploads", "files")

_FLAGS = (
    os.O_WRONLY
    | os.O_APPEND
    | sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY"))
)


class Identity(Struct):
    """The contents of session.json."""

    format: int
    session: Annotated[str, Meta(max_length=100)]


class Step(Struct):
    """The line of a step; its changes are fields of a document."""

    step: Number
    parent: Number
    name: str
    changes: dict[str, Any]


class Head(Struct):
    """The line of a head that moved."""

    head: Number


class Running(Struct):
    """The line of a search that begins, or that has ended."""

    running: Number | None


Line = Step | Head | Running


class Journal:
    """The steps of a session.

    Attributes
    ----------
    folder : Path
    name : str
        The session's name; random.
    running : int or None
        The running search; after the journal is opened, the search that was interrupted.
    loss : str
        A message about the damaged step that was left out when the session was opened; empty without damage.

    Raises
    ------
    InputError
        `bad-session`: the session is damaged, or of another version.
    FileError
        The session cannot be read or written.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = folder / "journal.jsonl"
        self.running: int | None = None
        self.loss = ""
        self._parents: dict[int, int] = {}
        self._changes: dict[int, dict[str, Any]] = {}
        self._left: dict[int, int] = {}
        self._head = 0
        self._runs = 0
        self._is_torn = False
        try:
            for sub in FOLDERS:
                (folder / sub).mkdir(parents=True, exist_ok=True)
            _refuse_links(folder)
            self.name = self._read_name()
            self._number, self._length = self._open()
        except OSError as error:
            raise unwritable(error.filename or folder, error) from error

    def _read_name(self) -> str:
        place = self.folder / "session.json"
        if os.path.lexists(place):
            try:
                data = decoded(bytes_of(place, "session"))
                if isinstance(data, dict) and data.get("format") != FORMAT:
                    reason = (
                        f"it has format {data.get('format')!r}, this version of Niwaki reads format {FORMAT}"
                    )
                    raise _bad(place, reason, "open it with the version of Niwaki that wrote it")
                identity: Identity = fitted(data, Identity)
                return identity.session
            except Unfit as error:
                cure = "remove this file, which has only the session's name, and start the studio again"
                raise _bad(place, str(error), cure) from error
        name = secrets.token_hex(8)
        write_whole(place, msgspec.json.encode(Identity(FORMAT, name)), private=True)
        return name

    def _open(self) -> tuple[int, int]:
        """Read the file; return its descriptor, open for more lines, and its length."""
        data = bytes_of(self.path, "journal") if os.path.lexists(self.path) else None
        lines = self._read(data or b"")
        if self.loss:
            damaged = self.folder / "journal.damaged"
            self.loss += f"\nA copy of the damaged file is {damaged}."
            write_whole(damaged, data or b"", private=True)
        # A file with a second name (a hard link) may be a file of another program.
        if lines != data or self.path.lstat().st_nlink > 1:
            write_whole(self.path, lines, private=True)
        return os.open(self.path, _FLAGS), len(lines)

    def _read(self, data: bytes) -> bytes:
        """Apply all steps and return the complete lines."""
        whole = data[: data.rfind(b"\n") + 1]
        lines, done = whole.splitlines(keepends=True), 0
        for number, line in enumerate(lines, 1):
            try:
                self._apply(self._parse(line))
            except Unfit as error:
                if number < len(lines):
                    cure = f"copy the file, then remove line {number} and all after it: the earlier steps are complete"
                    raise _bad(self.path, f"line {number}: {error}", cure) from error
                self.loss = f"The last step of this session is damaged on the disk and was left out: {error}"
                return whole[:done]
            done += len(line)
        return whole

    def _parse(self, line: bytes) -> Line:
        """Parse a line that may follow the lines read so far."""
        data = decoded(line)
        if not isinstance(data, dict):
            raise Unfit("$", "a step", "something else")
        if "step" in data:
            step: Step = fitted(data, Step)
            if step.step != len(self._parents) + 1 or step.parent >= step.step:
                expected = f"step {len(self._parents) + 1} after an earlier step"
                raise Unfit("$.step", expected, f"step {step.step} after step {step.parent}")
            if _is_deep(step.changes, limit("depth")):
                raise Unfit("$.changes", "a few nested tables at most", "many")
            if "pins" in step.changes:
                # Sessions of the first format have the name `pins`.
                step.changes["held"] = step.changes.pop("pins")
            try:
                fitted(step.changes, Document)
            except Unfit as error:
                raise error.inside(".changes") from error
            return step
        if "head" in data:
            head: Head = fitted(data, Head)
            if head.head > len(self._parents):
                raise Unfit("$.head", "an earlier step", str(head.head))
            return head
        running: Running = fitted(data, Running)
        return running

    def _apply(self, line: Line) -> None:
        """Apply a line to the state in memory."""
        match line:
            case Step():
                self._parents[line.step], self._changes[line.step] = line.parent, line.changes
                self._left[line.parent] = self._head = line.step
            case Head():
                self._head = line.head
            case Running():
                self.running = line.running
                self._runs = max(self._runs, -1 if line.running is None else line.running + 1)

    def _write(self, entry: Line) -> None:
        try:
            data = msgspec.json.encode(entry) + b"\n"
            # Only a line that can be read again is written.
            line = self._parse(data)
        except (Unfit, RecursionError) as error:
            raise CommandError("not-stored", f"this cannot be stored: {error}") from error
        if self._length + len(data) > limit("journal"):
            raise beyond("journal", f"it has {self._length:,} bytes", self.path)
        try:
            if self._is_torn:
                self._cut()
            self._is_torn = True
            write_all(self._number, data)
            os.fsync(self._number)
        except OSError as error:
            # If this fails, the next write cuts the file first.
            with suppress(OSError):
                self._cut()
            raise unwritable(self.path, error) from error
        self._is_torn = False
        self._length += len(data)
        self._apply(line)

    def _cut(self) -> None:
        """Cut off an incomplete line."""
        os.ftruncate(self._number, self._length)
        os.fsync(self._number)
        self._is_torn = False

    def step(self, name: str, changes: dict[str, Any]) -> None:
        """Write a step: new values of some fields of the document, as plain data."""
        self._write(Step(len(self._parents) + 1, self._head, name, changes))

    def run(self) -> int:
        """Begin a run; return its number."""
        number = self._runs
        self._write(Running(number))
        return number

    def end_run(self) -> None:
        """Note that the running search has ended."""
        self._write(Running(None))

    def undo(self) -> bool:
        """Move the head one step back, if there is such a step."""
        if not self._head:
            return False
        self._write(Head(self._parents[self._head]))
        return True

    def redo(self) -> bool:
        """Move the head to the step that was left last, if there is such a step."""
        onward = self._left.get(self._head)
        if onward is None:
            return False
        self._write(Head(onward))
        return True

    @property
    def undoable(self) -> int:
        """The number of steps that can be undone."""
        return len(self._path())

    @property
    def redoable(self) -> int:
        """The number of steps that can be redone."""
        count, at = 0, self._head
        while at in self._left:
            count, at = count + 1, self._left[at]
        return count

    def _path(self) -> list[int]:
        """List the steps from the first to the head."""
        steps, at = [], self._head
        while at:
            steps.append(at)
            at = self._parents[at]
        return steps[::-1]

    def document(self) -> Document:
        """Return the document at the head."""
        changes: dict[str, Any] = {}
        for step in self._path():
            changes |= self._changes[step]
        return Document().changed(changes)

    def runs_file(self, number: int) -> Path:
        """Return the path of a run's file."""
        return self.folder / "runs" / f"{number}.json"

    def close(self) -> None:
        """Close the file."""
        os.close(self._number)


def _is_deep(value: Any, levels: int) -> bool:
    """Whether lists and tables are nested in more than `levels` levels."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return not levels or any(_is_deep(member, levels - 1) for member in inner)


def _refuse_links(folder: Path) -> None:
    """Refuse links, through which the studio could write to any file of the user; a new key replaces a link `key`."""
    for place in _entries(folder, 3):
        if place == folder / "key":
            continue
        if place.is_symlink() or getattr(os.path, "isjunction", lambda _: False)(place):
            reason = "it is a link, and the studio would write to the file that it leads to"
            raise _bad(
                place,
                reason,
                "replace the link by its file or folder, or name another folder with `--session`",
            )


def _entries(folder: Path, levels: int) -> Iterable[Path]:
    """Go through the entries of a folder and of its folders."""
    for place in sorted(folder.iterdir()):
        yield place
        if levels > 1 and not place.is_symlink() and place.is_dir():
            yield from _entries(place, levels - 1)


def _bad(place: Path, reason: str, cure: str) -> InputError:
    return InputError("bad-session", path=place, reason=reason, cure=cure)
