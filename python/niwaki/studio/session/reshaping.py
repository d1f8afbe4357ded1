"""New forms of the active result: a part grown again, a choice with a new value, a changed model."""

from __future__ import annotations

import secrets
from typing import Any

from niwaki.studio import messages as m
from niwaki.studio.session.state import Session, of_model
from niwaki.studio.window import Window


async def reroll(session: Session, window: Window, command: m.Reroll) -> m.Answer:
    """Grow a part again, in place."""
    picked = session.document.picked
    job = m.Regrow(
        **session.source(picked),
        **session.fresh_run(),
        question=session.question(),
        part=command.part,
        count=command.count,
        strength=command.strength,
        seed=secrets.randbits(53),
    )
    answer = await session.desk.do(job, session.forward)
    if answer.outcomes:
        session.replace("reroll", picked, of_model(answer.outcomes, job.question.model))
    return answer


def choose(session: Session, window: Window, command: m.Choose) -> Any:
    """Follow a slider: the shape at its newest value while it moves, a result at its end."""
    session.slider[command.phase] = command
    return _choose(session, command)


async def _choose(session: Session, command: m.Choose) -> m.Answer | None:
    if session.slider.get(command.phase) is not command:
        return None
    return await _change(session, {command.address: command.value}, command.phase == "end", "choose")


async def reshape(session: Session) -> None:
    """Run the active result again with the present model and arguments."""
    answer = await _change(session, {}, True, "reload")
    if answer is not None and answer.problem is not None:
        session.problem = answer.problem
        session.tell_all()


async def _change(session: Session, changes: dict[str, Any], is_end: bool, origin: str) -> m.Answer | None:
    picked = session.document.picked
    if picked is None or not session.journal.runs_file(picked.run).is_file():
        return None
    job = m.Change(
        **session.source(picked),
        **(session.fresh_run() if is_end else {"run": 0, "file": ""}),
        question=session.question(),
        changes=changes,
        origin=origin,
    )
    answer = await session.desk.do(job, session.forward)
    # A search may have ended meanwhile, whose results are newer than what follows from a former one by itself.
    is_late = origin == "reload" and picked not in {outcome.key for outcome in session.document.results}
    if answer.outcomes and not is_late:
        session.replace(origin, picked, of_model(answer.outcomes, job.question.model))
    return answer
