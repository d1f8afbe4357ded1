"""Files below the folder that was named at the start: read, and written where they are models or notes."""

from __future__ import annotations

import asyncio
from pathlib import Path

from niwaki.errors.files import ensure_folder, write_whole
from niwaki.inputs.files import text_of
from niwaki.studio import messages as m
from niwaki.studio.session import loading, reporting
from niwaki.studio.session.root import PROGRAMS
from niwaki.studio.session.state import CommandError, Session
from niwaki.studio.window import Window

#: Formats that `write` writes, and those that `read` reads.
WRITTEN = (*PROGRAMS, ".md")
READ = (*WRITTEN, ".toml", ".txt", ".csv", ".json")
#: The most names of other files in a message.
BESIDE = 12


async def read(session: Session, window: Window, command: m.Read) -> None:
    """Send the text of a file."""
    place = _place(session, command.path, READ, "read")
    if not place.is_file():
        beside = sorted(path.name for path in place.parent.glob("*") if path.suffix in READ)
        listed = f"; beside it: {', '.join(beside[:BESIDE])}" if beside else ""
        raise CommandError("file-missing", f"there is no file `{command.path}`{listed}")
    text = await asyncio.to_thread(text_of, place, "model", "a text")
    window.tell(m.FileText(command.id, command.path, text))


async def write(session: Session, window: Window, command: m.Write) -> m.Answer | None:
    """Write a file, and check it if it is a model."""
    place = _place(session, command.path, WRITTEN, "written")
    await asyncio.to_thread(
        lambda: write_whole(ensure_folder(place.parent) / place.name, command.text.encode())
    )
    window.tell(m.FileText(command.id, command.path))
    if place.suffix != ".py":
        return None
    answer = await reporting.check_model(session, window, command.id, m.CheckModel(reference=str(place)))
    await loading.reload(session, {place})
    return answer


def _place(session: Session, name: str, formats: tuple[str, ...], verb: str) -> Path:
    """Return the path of a file of one of these formats.

    Raises
    ------
    CommandError
        `no-folder`, `outside-folder`, `file-format`.
    """
    if session.root is None:
        raise CommandError("no-folder", "no folder was named at the start: `niwaki mcp FOLDER` names one")
    place = session.root.path(name)
    if place.suffix.lower() not in formats:
        raise CommandError("file-format", f"`{name}` cannot be {verb}: only {', '.join(formats)} can")
    return place
