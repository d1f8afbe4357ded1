"""The active result, stars, undo and redo."""

from __future__ import annotations

from niwaki.studio import messages as m
from niwaki.studio.session import loading
from niwaki.studio.session.state import CommandError, Session
from niwaki.studio.window import Window


def pick(session: Session, window: Window, command: m.Pick) -> None:
    """Make a result the active result."""
    _check(session, command.key)
    if command.key != session.document.picked:
        session.step("pick", {"picked": command.key})


def star(session: Session, window: Window, command: m.Star) -> None:
    """Star a result, or remove its star."""
    _check(session, command.key)
    rest = [key for key in session.document.stars if key != command.key]
    session.step("star", {"stars": [*rest, command.key] if command.on else rest})


def undo(session: Session, window: Window, command: m.Undo) -> None:
    """Undo the last step."""
    _show_head(session, session.journal.undo())


def redo(session: Session, window: Window, command: m.Redo) -> None:
    """Redo the last undone step."""
    _show_head(session, session.journal.redo())


def _show_head(session: Session, has_moved: bool) -> None:
    """Show the document at the journal's head, which may have another model or target."""
    before = session.document.model, session.document.ask
    if has_moved:
        session.show_head()
    if before != (session.document.model, session.document.ask):
        session.start(loading.load(session))


def _check(session: Session, key: m.Key) -> None:
    if key not in {outcome.key for outcome in session.document.results}:
        raise CommandError("no-result", "this result is not in the gallery")
