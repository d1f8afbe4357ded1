"""Which result is worked on, which are kept, and the way back."""

from __future__ import annotations

from niwaki.studio import messages as m
from niwaki.studio.session import loading
from niwaki.studio.session.state import Refused, Session
from niwaki.studio.window import Window


def pick(session: Session, window: Window, command: m.Pick) -> None:
    """Go on with another result."""
    _known(session, command.key)
    if command.key != session.document.picked:
        session.step("pick", {"picked": command.key})


def star(session: Session, window: Window, command: m.Star) -> None:
    """Mark a result, or take the mark away."""
    _known(session, command.key)
    others = [one for one in session.document.stars if one != command.key]
    session.step("star", {"stars": [*others, command.key] if command.on else others})


def undo(session: Session, window: Window, command: m.Undo) -> None:
    """Take the last step back."""
    _turn(session, session.journal.undo())


def redo(session: Session, window: Window, command: m.Redo) -> None:
    """Take the step again that was taken back."""
    _turn(session, session.journal.redo())


def _turn(session: Session, has_moved: bool) -> None:
    """Show the document at the journal's head, which may have another model or target."""
    before = session.document.model, session.document.ask
    if has_moved:
        session.turned()
    if before != (session.document.model, session.document.ask):
        session.start(loading.load(session))


def _known(session: Session, key: m.Key) -> None:
    if key not in {one.key for one in session.document.results}:
        raise Refused("no-result", "that result is not in the gallery")
