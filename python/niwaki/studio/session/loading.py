"""Models and targets: what can be chosen, and the present ones, read again where a file has changed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.frames import frame
from niwaki.studio.session import reshaping
from niwaki.studio.session.state import Refused, Session
from niwaki.studio.window import Window, newest


async def begin(session: Session) -> None:
    """Learn which models there are, and show the session's own; then commands can be carried out."""

    def begun(answer: m.Answer) -> None:
        session.problem = answer.problem or session.problem
        session.ready.set()

    await session.start(_begun(session), begun)
    if session.document.model is not None:
        reference = session.document.model
        await session.searcher.do(m.Load(reference=reference, file=session.drawing_file(reference)))


async def _begun(session: Session) -> None:
    # The first search finds its process started, and the model read.
    session.start(session.searcher.do(m.ListModels(files=[])))
    answer = await session.desk.do(m.ListModels(files=session.files))
    session.models, session.targets, session.problem = answer.models, answer.targets, answer.problem
    if answer.problem is not None and session.files:
        # A file with an error does not hide the gallery.
        rest = await session.desk.do(m.ListModels(files=[]))
        broken = [m.ModelInfo(file, is_file=True) for file in session.files]
        session.models, session.targets = [*broken, *rest.models], rest.targets
    if session.document.model is None and session.models:
        session.step("model", {"model": session.models[0].reference})
    await load(session, keep=session.problem)


def choose_model(session: Session, window: Window, command: m.ChooseModel) -> None:
    """Take another model; starred results stay."""
    reference = command.reference
    if reference not in {one.reference for one in session.models}:
        reference = _of_named_file(session, reference)
    if not reference and not session.drawing_file(command.reference):
        text = f"`{command.reference}` is no model of the gallery, and was not named at the start"
        raise Refused("unknown-model", text)
    session.losses = ""
    fresh = {"model": reference or command.reference, "arguments": {}, "ask": m.Ask(), "held": []}
    session.step("model", {**fresh, "results": session.document.starred(), "picked": None})
    session.start(load(session))


def _of_named_file(session: Session, reference: str) -> str:
    """The reference of a model in a file that was named at the start, with the whole path; empty for any other."""
    place, colon, name = reference.rpartition(":")
    path = Path(place if colon else reference).resolve()
    named = {Path(one.rpartition(":")[0] or one) for one in session.files}
    return f"{path}{colon}{name}" if path in named else ""


async def load(session: Session, keep: m.Problem | None = None) -> None:
    """Read the session's model, again where its file has changed."""
    reference = session.document.model
    if reference is None:
        return
    answer = await session.desk.do(m.Load(reference=reference, file=session.drawing_file(reference)))
    session.problem = answer.problem or keep
    if answer.models:
        session.model = answer.models[0]
        session.models = [session.model if one.reference == reference else one for one in session.models]
        if session.model.is_file and session.model not in session.models:
            session.models.append(session.model)
    elif session.model is None or session.model.reference != reference:
        listed = (one for one in session.models if one.reference == reference)
        session.model = next(listed, None) or m.ModelInfo(reference, is_file=True)
    session.tell_all()
    if answer.problem is None:
        await load_ghost(session, None)


async def load_ghost(session: Session, window: Window | None) -> None:
    """Show the target, or that there is none, and the obstacles."""

    def report(header: Any, payload: bytes) -> None:
        found.append((newest(header), frame(msgspec.json.encode(header), payload)))

    found: list[tuple[str, bytes]] = []
    question = session.question()
    usual = None if session.model is None else session.model.target
    answer = await session.desk.do(m.Ghost(question=question), report)
    session.note = answer.note
    session.tell_all()
    if answer.problem is not None and window is not None:
        window.tell(m.Failed(0, answer.problem))
    if "ghost" not in dict(found):
        source = None
        if question.ask.sketch is None:
            source = question.ask.target.source if question.ask.target is not None else usual
        found.append(("ghost", frame(msgspec.json.encode(m.Shape(what="ghost", source=source)))))
    session.ghosts = dict(found)
    for one in session.windows:
        for kind, data in found:
            one.put(data, kind)


async def reload(session: Session, paths: set[Path]) -> None:
    """Models whose files have changed: read again, and the picked result run again with its choices."""
    for worker in (session.desk, session.searcher):
        await worker.drop(paths)
    reference = session.document.model
    if reference is None or Path(reference.rpartition(":")[0] or reference) not in paths:
        return
    await load(session)
    if session.problem is None and session.document.picked is not None:
        await reshaping.reshape(session)
