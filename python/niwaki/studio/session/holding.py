"""Held parts: the values that hold them are asked of a worker once, and go with each search."""

from __future__ import annotations

from niwaki.studio import messages as m
from niwaki.studio.session.state import Refused, Session
from niwaki.studio.window import Window


async def hold(session: Session, window: Window, command: m.HoldParts) -> m.Answer:
    """Hold parts of the picked result in what follows."""
    if command.color is None:
        source = session.source(session.document.picked)
        answer = await session.desk.do(m.Hold(**source, parts=command.parts))
    else:
        regions = [] if session.model is None else [one.name for one in session.model.regions]
        for name in command.parts:
            if name not in regions:
                raise Refused("no-region", f"the drawing has no region `{name}`")
        answer = m.Answer(held=[m.HeldPart(name, {name: command.color}) for name in command.parts])
    if answer.problem is None:
        left = [one for one in session.document.held if one.part not in command.parts]
        session.step("hold", {"held": [*left, *answer.held]})
    return answer


def free(session: Session, window: Window, command: m.FreeParts) -> None:
    """Hold them no more; all, where none is named."""
    left = [one for one in session.document.held if command.parts and one.part not in command.parts]
    session.step("free", {"held": left})
