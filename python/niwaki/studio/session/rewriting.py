"""Changes of the model's file: offers, and the offer that the user accepts."""

from __future__ import annotations

from niwaki.studio import messages as m
from niwaki.studio.session.showing import answering
from niwaki.studio.session.state import Session
from niwaki.studio.window import Window


async def propose(session: Session, window: Window, command: m.Propose) -> m.Answer:
    """Offer to make the arguments the defaults."""
    job = m.ProposeDefaults(question=session.question())
    return await session.desk.do(job, answering(window, command.id))


async def rewrite(session: Session, window: Window, command: m.Rewrite) -> m.Answer:
    """Write a change of the model's file; the session then reloads the file, as after any edit."""
    return await session.desk.do(m.RewriteFile(difference=command.difference))
