"""Views of a result for one window: choices, shape, difference from the target, check of a structure."""

from __future__ import annotations

from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.frames import frame
from niwaki.studio.session.state import Session
from niwaki.studio.window import Window


async def describe(session: Session, window: Window, command: m.Describe) -> m.Answer:
    """Send the choices of a result, with their places in the source."""

    def report(message: Any, payload: bytes) -> None:
        window.tell(msgspec.structs.replace(message, id=command.id))

    job = m.DescribeRun(**session.source(command.key), question=session.question(), key=command.key)
    return await session.desk.do(job, report)


async def judge(session: Session, window: Window, command: m.Judge) -> m.Answer:
    """Check whether a structure stands."""

    def report(message: Any, payload: bytes) -> None:
        window.tell(msgspec.structs.replace(message, id=command.id))

    job = m.JudgeRun(**session.source(command.key), key=command.key, simulate=command.simulate)
    return await session.desk.do(job, report)


async def show(session: Session, window: Window, command: m.Show) -> m.Answer:
    """Send the shape of a result."""

    def report(header: Any, payload: bytes) -> None:
        header.id = 0
        session.keep(command.key, command.detail, frame(msgspec.json.encode(header), payload))

    source, answer = session.source(command.key), m.Answer()
    if session.shape(command.key, command.detail) is None:
        job = m.ShowRun(**source, key=command.key, detail=command.detail)
        answer = await session.desk.do(job, report)
    shape = session.shape(command.key, command.detail)
    if shape is not None:
        window.put(shape)
    return answer


async def show_difference(session: Session, window: Window, command: m.ShowDifference) -> m.Answer:
    """Send the difference between a result and its target."""

    def report(header: Any, payload: bytes) -> None:
        header.id = command.id
        window.put(frame(msgspec.json.encode(header), payload))

    job = m.FindDifference(**session.source(command.key), key=command.key)
    return await session.desk.do(job, report)
