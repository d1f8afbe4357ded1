"""Dragging a part: the shape at the newest point of the pointer while it moves, results at its end."""

from __future__ import annotations

import secrets
from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.session.state import Session, of_model
from niwaki.studio.window import Window

#: The effort of growing the rest again.
EFFORT = 0.25


async def drag(session: Session, window: Window, command: m.Drag) -> m.Answer | None:
    """Drag a part of the active result."""
    picked, is_end = session.document.picked, command.phase == "end"
    source = session.source(picked)
    session.dragged = command
    async with session.dragging:
        if session.dragged is not command or command.phase == "cancel":
            return None
        job = m.DragPart(
            **source,
            **(session.fresh_run() if is_end else {}),
            question=session.question(),
            part=command.part,
            to=command.to,
            grab=command.grab,
            along=command.along,
        )

        def report(message: Any, payload: bytes) -> None:
            if isinstance(message, m.Dragged):
                window.tell(msgspec.structs.replace(message, id=command.id))
            else:
                session.forward(message, payload)

        answer = await session.desk.do(job, report)
    if answer.outcomes:
        results = of_model(answer.outcomes, job.question.model)
        session.replace("drag", picked, results)
        if command.follow:
            await _follow(session, results[0].key, job.question, answer.held)
    return answer


async def _follow(session: Session, picked: m.Key, question: m.Question, held: list[m.HeldPart]) -> None:
    """Improve the rest around the part, from the result of the drag."""
    if session.searching is not None:
        return
    hold = question.hold | {name: value for part in held for name, value in part.choices.items()}
    settings = m.Settings(count=1, effort=EFFORT)
    job = m.Grow(
        **session.fresh_run(),
        question=msgspec.structs.replace(question, hold=hold, settings=settings),
        seed=secrets.randbits(53),
        **session.source(picked),
    )
    answer = await session.searcher.do(job, session.forward)
    session.report_problem(answer)
    if answer.outcomes and session.document.picked == picked:
        session.replace("follow", picked, of_model(answer.outcomes, question.model))
