"""Changes of the model's file: offers, and the offer that the user accepts."""

from __future__ import annotations

from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.session.state import Session
from niwaki.studio.window import Window


async def propose(session: Session, window: Window, command: m.Propose) -> m.Answer:
    """Offer to make the arguments the defaults."""

    def report(message: Any, payload: bytes) -> None:
        window.tell(msgspec.structs.replace(message, id=command.id))

    return await session.desk.do(m.ProposeDefaults(question=session.question()), report)


async def rewrite(session: Session, window: Window, command: m.Rewrite) -> m.Answer:
    """Write a change of the model's file; the session then reloads the file, as after any edit."""
    return await session.desk.do(m.RewriteFile(difference=command.difference))
