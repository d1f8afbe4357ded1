"""Exported files: a result as a file, fetched by the hash of its bytes."""

from __future__ import annotations

import asyncio
import hashlib
import re
from pathlib import Path

from niwaki.errors.files import ensure_folder, write_whole
from niwaki.studio import messages as m
from niwaki.studio.session.state import Session
from niwaki.studio.window import Window


async def export(session: Session, window: Window, command: m.Export) -> m.Answer:
    """Write a result as a file, or as its recipe."""
    source, files = session.source(command.key), session.journal.folder / "files"
    folder = files / f"{command.key.run}-{command.key.number}"
    answer = await session.desk.do(
        m.WriteFile(
            **source,
            format=command.format,
            folder=str(folder),
            scale=command.scale,
            board=command.board,
            kerf=command.kerf,
        )
    )
    if answer.problem is None:
        written = Path(answer.path)
        data = await asyncio.to_thread(written.read_bytes)
        name = hashlib.sha256(data).hexdigest()
        place = files / name / f"{_stem(session, command.key)}{written.suffix}"
        if not place.is_file():
            await asyncio.to_thread(lambda: write_whole(ensure_folder(place.parent) / place.name, data))
        window.tell(m.File(command.id, name, place.name, str(place.resolve())))
    return answer


def _stem(session: Session, key: m.Key) -> str:
    """Return the name of a file without its suffix: the model, the number of the run, and the place in the run."""
    listed = (outcome.model for outcome in session.document.results if outcome.key == key)
    reference = next(listed, session.document.model or "")
    bare = re.sub(r"^drawing:upload:.*", "drawing", reference).rpartition(":")[2]
    bare = re.sub(r"[^\w-]+", "-", Path(bare).name.removesuffix(".py")).strip("-")
    return f"{bare or 'result'}-{key.run + 1}-{key.number + 1}"
