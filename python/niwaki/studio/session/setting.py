"""Goals, arguments and settings."""

from __future__ import annotations

from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.session import loading, reshaping
from niwaki.studio.session.state import CommandError, Session
from niwaki.studio.window import Window

#: The most arguments of a model.
ARGUMENTS = 200


def set_ask(session: Session, window: Window, command: m.SetAsk) -> None:
    """Change the goals of the search."""
    changes = _set_fields(command.ask)
    if changes.get("target") is not None:
        changes.setdefault("sketch", None)
    if changes.get("sketch") is not None:
        changes.setdefault("target", None)
    ask = msgspec.structs.replace(session.document.ask, **changes)
    for solid in (ask.target, *ask.obstacles):
        if solid is not None and session.file_of(solid.source) is None:
            raise CommandError("no-target", f"there is no target `{solid.source}`")
    if ask != session.document.ask:
        session.step("ask", {"ask": ask})
    session.start(loading.load_ghost(session, window))


def set_values(session: Session, window: Window, command: m.Set) -> None:
    """Set arguments or settings; new arguments also change the active result."""
    changes: dict[str, Any] = {}
    if command.settings is not None:
        settings = msgspec.structs.replace(session.document.settings, **_set_fields(command.settings))
        changes["settings"] = settings
    if command.arguments is not None:
        changes["arguments"] = {**session.document.arguments, **command.arguments}
        if len(changes["arguments"]) > ARGUMENTS:
            raise CommandError("too-many", f"a model has at most {ARGUMENTS} arguments")
    if changes:
        session.step("set", changes)
    if command.arguments is not None and session.document.picked is not None:
        session.start(reshaping.reshape(session))


def _set_fields(changes: msgspec.Struct) -> dict[str, Any]:
    """Collect the fields that have a value."""
    return {
        name: value for name, value in msgspec.structs.asdict(changes).items() if value is not msgspec.UNSET
    }
