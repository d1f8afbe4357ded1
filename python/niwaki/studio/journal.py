"""A session on disk: a line for each step, on the disk before anything of it is shown.

    DIR/session.json     the session's name and the format, written whole
    DIR/journal.jsonl    one line for each step: {"step": n, "parent": m, "name": ..., "changes": {...}},
                         or a head that moved: {"head": n}, or a search that began or ended: {"running": n or null}
    DIR/runs/N.json      a search with its results (`niwaki replay` reads it)
    DIR/uploads/         meshes by the SHA-256 of what was sent
    DIR/files/           what was exported
    DIR/journal.damaged  the journal as it was, where its last line was damaged

Steps form a tree, and are numbered from 1 in the order in which they were done. Undo moves the head to the parent of a
step, redo to the step that was left last.

A line is whole or is not there: where writing it fails, the file is cut back, and the step was not done. A last line
that is cut short (the process was killed while it wrote) or damaged is left out. All of a session lies in its folder:
no link leads out of it.
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
from niwaki.studio.refused import Refused

FORMAT = 1

#: Folders of a session.
FOLDERS = ("runs", "uploads", "files")

_FLAGS = (
    os.O_WRONLY
    | os.O_APPEND
    | sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY"))
)


class Named(Struct):
    """What is in session.json."""

    format: int
    session: Annotated[str, Meta(max_length=100)]


class Step(Struct):
    """A line of a step; its changes are fields of a document."""

    step: Number
    parent: Number
    name: str
    changes: dict[str, Any]


class Head(Struct):
    """A line of a head that has moved."""

    head: Number


class Running(Struct):
    """A line of a search that begins, or that has ended."""

    running: Number | None


Line = Step | Head | Running


class Journal:
    """The steps of a session.

    Attributes
    ----------
    folder : Path
    name : str
        Of the session; random.
    running : int or None
        The search that had begun and not ended when the journal was opened, then the one that runs.
    loss : str
        What was left out of a damaged session when it was opened; empty where nothing was.

    Raises
    ------
    InputError
        `bad-session`: it is damaged, or of another version.
    FileError
        It cannot be read or written.
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
            self.name = self._named()
            self._number, self._length = self._opened()
        except OSError as error:
            raise unwritable(error.filename or folder, error) from error

    def _named(self) -> str:
        place = self.folder / "session.json"
        if os.path.lexists(place):
            try:
                data = decoded(bytes_of(place, "session"))
                if isinstance(data, dict) and data.get("format") != FORMAT:
                    reason = f"it has format {data.get('format')!r}, this version reads {FORMAT}"
                    raise _bad(place, reason, "open it with the version of Niwaki that wrote it")
                named: Named = fitted(data, Named)
                return named.session
            except Unfit as error:
                cure = "remove this file, and start the studio again: it holds only the session's name"
                raise _bad(place, str(error), cure) from error
        name = secrets.token_hex(8)
        write_whole(place, msgspec.json.encode(Named(FORMAT, name)), private=True)
        return name

    def _opened(self) -> tuple[int, int]:
        """Read the file; its number, open for more lines, and its length."""
        data = bytes_of(self.path, "journal") if os.path.lexists(self.path) else None
        kept = self._read(data or b"")
        if self.loss:
            damaged = self.folder / "journal.damaged"
            self.loss += f"\nThe file as it was is {damaged}."
            write_whole(damaged, data or b"", private=True)
        # A file that has another name beside this one is another's, too.
        if kept != data or self.path.lstat().st_nlink > 1:
            write_whole(self.path, kept, private=True)
        return os.open(self.path, _FLAGS), len(kept)

    def _read(self, data: bytes) -> bytes:
        """Do all steps, and return the lines that are whole."""
        whole = data[: data.rfind(b"\n") + 1]
        lines, done = whole.splitlines(keepends=True), 0
        for number, line in enumerate(lines, 1):
            try:
                self._take(self._fit(line))
            except Unfit as error:
                if number < len(lines):
                    cure = f"keep a copy of it, and remove line {number} and all after it: the steps before are whole"
                    raise _bad(self.path, f"line {number}: {error}", cure) from error
                self.loss = f"The last step of this session was damaged on the disk, and is left out: {error}"
                return whole[:done]
            done += len(line)
        return whole

    def _fit(self, line: bytes) -> Line:
        """A line, where it can follow those that were read."""
        data = decoded(line)
        if not isinstance(data, dict):
            raise Unfit("$", "a step", "something else")
        if "step" in data:
            step: Step = fitted(data, Step)
            if step.step != len(self._parents) + 1 or step.parent >= step.step:
                expected = f"step {len(self._parents) + 1} after one that was done"
                raise Unfit("$.step", expected, f"step {step.step} after step {step.parent}")
            if _is_deep(step.changes, limit("depth")):
                raise Unfit("$.changes", "at most a few tables in one another", "many")
            if "pins" in step.changes:
                # As sessions of the first format name it.
                step.changes["held"] = step.changes.pop("pins")
            try:
                fitted(step.changes, Document)
            except Unfit as error:
                raise error.inside(".changes") from error
            return step
        if "head" in data:
            head: Head = fitted(data, Head)
            if head.head > len(self._parents):
                raise Unfit("$.head", "a step that was done", str(head.head))
            return head
        running: Running = fitted(data, Running)
        return running

    def _take(self, line: Line) -> None:
        """Bring what is in memory up to date by one line."""
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
            # What is written can be read again.
            line = self._fit(data)
        except (Unfit, RecursionError) as error:
            raise Refused("not-stored", f"this cannot be stored: {error}") from error
        if self._length + len(data) > limit("journal"):
            raise beyond("journal", f"it has {self._length:,} bytes", self.path)
        try:
            if self._is_torn:
                self._cut()
            self._is_torn = True
            write_all(self._number, data)
            os.fsync(self._number)
        except OSError as error:
            # Otherwise before the next line.
            with suppress(OSError):
                self._cut()
            raise unwritable(self.path, error) from error
        self._is_torn = False
        self._length += len(data)
        self._take(line)

    def _cut(self) -> None:
        """Cut off what is no whole line."""
        os.ftruncate(self._number, self._length)
        os.fsync(self._number)
        self._is_torn = False

    def step(self, name: str, changes: dict[str, Any]) -> None:
        """Do a step: other values of some fields of the document, as plain data."""
        self._write(Step(len(self._parents) + 1, self._head, name, changes))

    def run(self) -> int:
        """The number of a run that begins."""
        number = self._runs
        self._write(Running(number))
        return number

    def ended(self) -> None:
        """The search that ran has ended."""
        self._write(Running(None))

    def undo(self) -> bool:
        """Move the head one step back, if there is one."""
        if not self._head:
            return False
        self._write(Head(self._parents[self._head]))
        return True

    def redo(self) -> bool:
        """Move the head to the step that was left last, if there is one."""
        onward = self._left.get(self._head)
        if onward is None:
            return False
        self._write(Head(onward))
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
        return Document().changed(changes)

    def runs_file(self, number: int) -> Path:
        """The file of a run."""
        return self.folder / "runs" / f"{number}.json"

    def close(self) -> None:
        """Close the file."""
        os.close(self._number)


def _is_deep(value: Any, levels: int) -> bool:
    """Whether lists and tables lie in one another in more than so many levels."""
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return not levels or any(_is_deep(one, levels - 1) for one in inner)


def _refuse_links(folder: Path) -> None:
    """A link could lead what is written here to any file of the user; the key takes the place of one."""
    for place in _inside(folder, 3):
        if place == folder / "key":
            continue
        if place.is_symlink() or getattr(os.path, "isjunction", lambda _: False)(place):
            reason = "it is a link, and what the studio writes would go where it leads"
            raise _bad(
                place, reason, "put what it leads to in its place, or name another folder with `--session`"
            )


def _inside(folder: Path, levels: int) -> Iterable[Path]:
    """What is in a folder and in its folders."""
    for place in sorted(folder.iterdir()):
        yield place
        if levels > 1 and not place.is_symlink() and place.is_dir():
            yield from _inside(place, levels - 1)


def _bad(place: Path, reason: str, cure: str) -> InputError:
    return InputError("bad-session", path=place, reason=reason, cure=cure)
