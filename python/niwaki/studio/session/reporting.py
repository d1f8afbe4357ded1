"""Reports: fields of the state; a model checked, run without a target, explained; parameters fitted."""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Awaitable
from typing import Any

import msgspec

from niwaki.errors.files import ensure_folder
from niwaki.studio import messages as m
from niwaki.studio.session.root import is_program
from niwaki.studio.session.showing import answering
from niwaki.studio.session.state import CommandError, Session
from niwaki.studio.window import Window


def look(session: Session, window: Window, command: m.Look) -> None:
    """Send fields of the state."""
    view = msgspec.to_builtins(session.view())
    for name in command.fields:
        if name not in view:
            raise CommandError("no-field", f"the state has no `{name}`: it has {', '.join(view)}")
    window.tell(m.Looked(command.id, {name: view[name] for name in command.fields}))


def check(session: Session, window: Window, command: m.Check) -> Awaitable[m.Answer]:
    """Compile a model, and report on it."""
    reference = command.reference or _model(session)
    if session.root is not None and is_program(reference):
        reference = session.root.reference(reference)
    result = {} if command.key is None else session.source(command.key)
    job = m.CheckModel(**result, reference=reference)
    if reference == session.document.model:
        job.arguments = session.document.arguments
    return check_model(session, window, command.id, job)


async def check_model(session: Session, window: Window, command: int, job: m.CheckModel) -> m.Answer:
    """Compile a model, and send the report to a window."""
    return await session.desk.do(job, answering(window, command))


async def preview(session: Session, window: Window, command: m.Preview) -> m.Answer:
    """Run the model without a target."""
    _model(session)
    job = m.PreviewRuns(question=session.question(), count=command.count, seed=_seed(command.seed))
    return await session.desk.do(job, answering(window, command.id))


async def explain(session: Session, window: Window, command: m.Explain) -> m.Answer:
    """Count the calls that each strategy runs again for one changed choice."""
    _model(session)
    job = m.ExplainChange(question=session.question(), choice=command.choice, seed=_seed(command.seed))
    return await session.desk.do(job, answering(window, command.id))


async def fit(session: Session, window: Window, command: m.Fit) -> m.Answer:
    """Fit the parameters of a model that somebody else wrote."""
    if session.root is None or not is_program(command.reference):
        text = (
            "name a file below the folder that was named at the start: file.py:function, or an OpenSCAD file"
        )
        raise CommandError("no-generator", text)
    reference = session.root.reference(command.reference)
    solid = session.file_of(command.target.source)
    if solid is None:
        raise CommandError("no-target", f"there is no target `{command.target.source}`")
    target = msgspec.structs.replace(command.target, source=solid)
    name = hashlib.sha256(msgspec.json.encode((reference, target, command.seed, command.align))).hexdigest()
    job = m.FitParameters(
        reference=reference,
        target=target,
        evaluations=command.evaluations,
        seed=command.seed,
        align=command.align,
        folder=str(ensure_folder(session.journal.folder / "fits" / name[:16]).resolve()),
    )
    answer = answering(window, command.id)

    def report(message: Any, payload: bytes) -> None:
        if not isinstance(message, m.Progressed):
            answer(message, payload)

    return await session.searcher.do(job, report)


def _model(session: Session) -> str:
    """Return the reference of the present model."""
    if session.document.model is None:
        raise CommandError("no-model", "choose a model first")
    return session.document.model


def _seed(seed: int | None) -> int:
    return secrets.randbits(53) if seed is None else seed
