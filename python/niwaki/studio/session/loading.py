"""Models and targets: their lists, and the present model and target, loaded again after a change of a file."""

from __future__ import annotations

import asyncio
import math
from pathlib import Path
from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.frames import frame
from niwaki.studio.session import reshaping
from niwaki.studio.session.root import is_program
from niwaki.studio.session.state import CommandError, Session
from niwaki.studio.window import Window, newest

#: Models of the first screen.
GLIMPSES = 6
#: Seconds after a reload in which the same text of the file belongs to the same save.
SETTLING = 1.0


async def begin(session: Session, glimpses: bool = True) -> None:
    """List the models and load the session's model; then the session is ready for commands.

    Parameters
    ----------
    session
        The session.
    glimpses
        Whether to show a run of the first models of the list, for the first screen of the page.
    """

    def report(answer: m.Answer) -> None:
        session.problem = answer.problem or session.problem
        session.ready.set()

    await session.start(_load_lists(session, glimpses), report)
    if session.document.model is not None:
        reference = session.document.model
        await session.searcher.do(m.Load(reference=reference, file=session.drawing_file(reference)))


async def _load_lists(session: Session, glimpses: bool) -> None:
    # This starts the process of the first search in advance.
    session.start(session.searcher.do(m.ListModels(files=[])))
    answer = await session.desk.do(m.ListModels(files=session.files))
    session.models, session.targets, session.problem = answer.models, answer.targets, answer.problem
    if answer.problem is not None and session.files:
        # A file with an error does not hide the gallery.
        listed = await session.desk.do(m.ListModels(files=[]))
        broken = [m.ModelInfo(file, is_file=True) for file in session.files]
        session.models, session.targets = [*broken, *listed.models], listed.targets
    if session.document.model is None and session.models:
        session.step("model", {"model": session.models[0].reference})
    await load(session, earlier=session.problem)
    if glimpses and not session.document.results:
        session.start(_load_glimpses(session))


async def _load_glimpses(session: Session) -> None:
    """Show a run of the first models of the list, to choose from before there are results."""

    def report(header: Any, payload: bytes) -> None:
        kind, data = newest(header), frame(msgspec.json.encode(header), payload)
        session.glimpses[kind] = data
        for window in session.windows:
            window.put(data, kind)

    # A run of a drawing model is seldom more than a line; a model with a target shows what it is.
    shown = [model for model in session.models if model.is_file or (model.kind == "scene" and model.target)]
    scenes = [model.reference for model in shown]
    for reference in scenes[:GLIMPSES]:
        await session.desk.do(m.Glimpse(reference=reference), report)


def choose_model(session: Session, window: Window, command: m.ChooseModel) -> None:
    """Choose another model; the results of every model stay."""
    reference = command.reference
    if reference not in {model.reference for model in session.models}:
        reference = _of_named_file(session, reference)
    if not reference and not session.drawing_file(command.reference):
        text = (
            f"`{command.reference}` is not a model of the gallery, nor of a file that was named at the start"
        )
        raise CommandError("unknown-model", text)
    session.losses = ""
    model = reference or command.reference
    fresh = {"model": model, "arguments": {}, "ask": m.Ask(), "held": []}
    session.step("model", {**fresh, "picked": session.document.first(model)})
    session.start(load(session))


def _of_named_file(session: Session, reference: str) -> str:
    """Return a reference with the absolute path if its file, or a folder around it, was named at the start, else ""."""
    if session.root is not None and is_program(reference):
        return session.root.reference(reference)
    place, colon, name = reference.rpartition(":")
    path = Path(place if colon else reference).resolve()
    named = {Path(file.rpartition(":")[0] or file) for file in session.files}
    return f"{path}{colon}{name}" if path in named else ""


async def load(session: Session, earlier: m.Problem | None = None) -> None:
    """Load the session's model, again if its file has changed."""
    reference = session.document.model
    if reference is None:
        return
    answer = await session.desk.do(m.Load(reference=reference, file=session.drawing_file(reference)))
    session.problem = answer.problem or earlier
    if answer.models:
        session.model = answer.models[0]
        session.models = [
            session.model if model.reference == reference else model for model in session.models
        ]
        if session.model.is_file and session.model not in session.models:
            session.models.append(session.model)
    elif session.model is None or session.model.reference != reference:
        listed = (model for model in session.models if model.reference == reference)
        session.model = next(listed, None) or m.ModelInfo(reference, is_file=True)
    session.tell_all()
    if answer.problem is None:
        await load_ghost(session, None)


async def load_ghost(session: Session, window: Window | None) -> None:
    """Show the target and the obstacles; without a target, send an empty ghost."""

    def report(header: Any, payload: bytes) -> None:
        frames.append((newest(header), frame(msgspec.json.encode(header), payload)))

    frames: list[tuple[str, bytes]] = []
    question = session.question()
    usual = None if session.model is None else session.model.target
    answer = await session.desk.do(m.Ghost(question=question), report)
    session.note = answer.note
    aim = session.document.ask.target
    if answer.problem is not None and window is not None:
        window.tell(m.Failed(0, answer.problem))
    session.sizes = _with_source(answer.sizes, usual if aim is None else aim.source)
    session.tell_all()
    kinds = dict(frames)
    for kind, empty in (("mask", m.Mask()), ("prior", m.Shape(role="prior"))):
        if kind not in kinds:
            frames.append((kind, frame(msgspec.json.encode(empty))))
    if "ghost" not in kinds:
        source = None
        if question.ask.sketch is None:
            source = question.ask.target.source if question.ask.target is not None else usual
        frames.append(("ghost", frame(msgspec.json.encode(m.Shape(role="ghost", source=source)))))
    before, session.ghosts = session.ghosts, dict(frames)
    for kind, data in frames:
        # A run of the model is large, and seldom another one.
        if kind != "prior" or before.get(kind) != data:
            for each in session.windows:
                each.put(data, kind)


def _with_source(sizes: m.Sizes, source: str | None) -> m.Sizes:
    """Return sizes whose offers name the source of the target, which a worker knows by its file."""
    if source is None:
        return sizes
    offers = [
        msgspec.structs.replace(offer, target=msgspec.structs.replace(offer.target, source=source))
        for offer in sizes.offers
    ]
    return msgspec.structs.replace(sizes, offers=offers)


async def reload(session: Session, paths: set[Path]) -> None:
    """Load models of changed files again, and run the active result again with its choices.

    The changes of one save may arrive apart: during a reload, and `SETTLING` seconds after it, the same text is not
    loaded again.
    """
    for worker in (session.desk, session.searcher):
        await worker.drop(paths)
    reference = session.document.model
    place = Path() if reference is None else Path(reference.rpartition(":")[0] or reference)
    if place not in paths:
        return
    save, clock = (place, await asyncio.to_thread(_content, place)), asyncio.get_running_loop().time
    if save == session.save and clock() < session.settled:
        return
    session.save, session.settled = save, math.inf
    try:
        await load(session)
        if session.problem is None and session.document.picked is not None:
            await reshaping.reshape(session)
    finally:
        session.settled = clock() + SETTLING


def _content(path: Path) -> bytes | None:
    """Return the bytes of a file; None if it cannot be read."""
    try:
        return path.read_bytes()
    except OSError:
        return None
