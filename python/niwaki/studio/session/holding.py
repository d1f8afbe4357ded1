"""Held parts: a worker returns the values of their choices once, and each search keeps these values."""

from __future__ import annotations

from niwaki.studio import messages as m
from niwaki.studio.session.state import CommandError, Session
from niwaki.studio.window import Window


async def hold(session: Session, window: Window, command: m.HoldParts) -> m.Answer:
    """Hold parts of the active result in further searches."""
    if command.color is None:
        source = session.source(session.document.picked)
        answer = await session.desk.do(m.Hold(**source, parts=command.parts))
    else:
        regions = [] if session.model is None else [region.name for region in session.model.regions]
        for name in command.parts:
            if name not in regions:
                raise CommandError("no-region", f"the drawing has no region `{name}`")
        answer = m.Answer(held=[m.HeldPart(name, {name: command.color}) for name in command.parts])
    if answer.problem is None:
        rest = [part for part in session.document.held if part.part not in command.parts]
        session.step("hold", {"held": [*rest, *answer.held]})
    return answer


def free(session: Session, window: Window, command: m.FreeParts) -> None:
    """Free held parts; all parts if none is named."""
    rest = [part for part in session.document.held if command.parts and part.part not in command.parts]
    session.step("free", {"held": rest})
