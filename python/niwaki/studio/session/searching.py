"""A search, one at a time: it shows the best so far while it runs, and its results in the gallery at its end."""

from __future__ import annotations

import secrets
from collections.abc import Awaitable

from niwaki.studio import messages as m
from niwaki.studio.session.state import CommandError, Session, of_model
from niwaki.studio.window import Window


def run(session: Session, window: Window, command: m.Run) -> Awaitable[m.Answer]:
    """Start a search; a running search is cancelled first and its results are dropped."""
    if session.document.model is None:
        raise CommandError("no-model", "choose a model first")
    number = session.journal.run()
    if session.search is not None:
        session.search.cancel()
    session.is_interrupted, session.losses = False, ""
    session.searching = m.Searching(number)
    session.tell_all()
    # `obey` reports the end to the window, so this callback has no work.
    session.search = session.start(_search(session, number), lambda answer: None)
    return session.search


def stop(session: Session, window: Window, command: m.Stop) -> None:
    """Stop the search and keep its results so far."""
    session.start(session.searcher.stop())


async def _search(session: Session, number: int) -> m.Answer:
    seed = session.document.settings.seed
    try:
        job = m.Grow(
            question=session.question(),
            run=number,
            seed=secrets.randbits(53) if seed is None else seed,
            file=str(session.journal.runs_file(number)),
        )
        answer = await session.searcher.do(job, session.forward)
    except Exception:
        session.searching = None
        session.tell_all()
        raise
    session.searching, session.losses = None, answer.note
    try:
        session.journal.end_run()
        results = of_model(answer.outcomes, job.question.model)
        if results:
            document = session.document
            picked = results[0].key if results[0].model == document.model else document.picked
            session.step("run", {"results": [*document.kept(), *results], "picked": picked})
    finally:
        session.tell_all()
    return answer
