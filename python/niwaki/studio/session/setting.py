"""What is asked: targets, arguments, settings."""

from __future__ import annotations

from typing import Any

from niwaki.studio import messages as m
from niwaki.studio.session import loading, reshaping
from niwaki.studio.session.state import Refused, Session
from niwaki.studio.window import Window


def set_ask(session: Session, window: Window, command: m.SetAsk) -> None:
    """Say what the scene should be like."""
    source = command.ask.target.source if command.ask.target is not None else None
    if source is not None and session.file_of(source) is None:
        raise Refused("no-target", f"there is no target `{source}`")
    session.step("ask", {"ask": command.ask})
    session.start(loading.load_ghost(session, window))


def set_values(session: Session, window: Window, command: m.Set) -> None:
    """Other arguments or settings; the picked result follows its arguments."""
    changes: dict[str, Any] = {}
    if command.settings is not None:
        changes["settings"] = command.settings
    if command.arguments is not None:
        changes["arguments"] = {**session.document.arguments, **command.arguments}
    if changes:
        session.step("set", changes)
    if command.arguments is not None and session.document.picked is not None:
        session.start(reshaping.reshape(session))
