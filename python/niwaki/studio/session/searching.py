"""A search: one at a time, the best so far shown while it runs, its results in the gallery at its end."""

from __future__ import annotations

import secrets
from collections.abc import Awaitable

from niwaki.studio import messages as m
from niwaki.studio.session.state import Refused, Session, of_model
from niwaki.studio.window import Window


def run(session: Session, window: Window, command: m.Run) -> Awaitable[m.Answer]:
    """Search; one that runs is ended first, and nothing of it is kept."""
    if session.document.model is None:
        raise Refused("no-model", "choose a model first")
    number = session.journal.run()
    if session.search is not None:
        session.search.cancel()
    session.is_interrupted, session.losses = False, ""
    session.searching = m.Searching(number)
    session.tell_all()
    # The window that asked is told how it has ended.
    session.search = session.start(_searched(session, number), lambda answer: None)
    return session.search


def stop(session: Session, window: Window, command: m.Stop) -> None:
    """Stop the search; what it has found becomes results."""
    session.start(session.searcher.stop())


async def _searched(session: Session, number: int) -> m.Answer:
    seed = session.document.settings.seed
    try:
        job = m.Grow(
            question=session.question(),
            run=number,
            seed=secrets.randbits(53) if seed is None else seed,
            file=str(session.journal.runs_file(number)),
        )
        answer = await session.searcher.do(job, session.reported)
    except Exception:
        session.searching = None
        session.tell_all()
        raise
    session.searching, session.losses = None, answer.note
    try:
        session.journal.ended()
        found = of_model(answer.outcomes, job.question.model)
        if found:
            document = session.document
            picked = found[0].key if found[0].model == document.model else document.picked
            session.step("run", {"results": [*document.starred(), *found], "picked": picked})
    finally:
        session.tell_all()
    return answer
