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
    is_running = session.search is not None and not session.search.done()
    if session.search is not None:
        session.search.cancel()
    session.is_interrupted, session.losses = False, ""
    number = session.journal.run()
    session.searching = m.Searching(number)
    session.tell_all()
    session.search = session.start(_searched(session, number, is_running))
    return session.search


def stop(session: Session, window: Window, command: m.Stop) -> None:
    """Stop the search; what it has found becomes results."""
    session.start(session.searcher.stop())


async def _searched(session: Session, number: int, is_other_running: bool) -> m.Answer:
    if is_other_running:
        await session.searcher.kill()
    seed = session.document.settings.seed
    job = m.Grow(
        question=session.question(),
        run=number,
        seed=secrets.randbits(53) if seed is None else seed,
        file=str(session.journal.runs_file(number)),
    )
    answer = await session.searcher.do(job, session.reported)
    session.searching, session.losses = None, answer.note
    session.journal.ended()
    found = of_model(answer.outcomes, job.question.model)
    if found:
        document = session.document
        picked = found[0].key if found[0].model == document.model else document.picked
        session.step("run", {"results": [*document.starred(), *found], "picked": picked})
    session.tell_all()
    return answer
