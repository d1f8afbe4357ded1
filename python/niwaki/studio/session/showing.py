"""Views of a result for one window: choices, shape, difference from the target, check of a structure."""

from __future__ import annotations

from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.frames import frame
from niwaki.studio.process import Report
from niwaki.studio.session.state import Session
from niwaki.studio.window import Window


def answering(window: Window, command: int) -> Report:
    """Return a function that sends a worker's reports to one window, as the answers to a command."""

    def report(message: Any, payload: bytes) -> None:
        message.id = command
        if payload:
            window.put(frame(msgspec.json.encode(message), payload))
        else:
            window.tell(message)

    return report


async def describe(session: Session, window: Window, command: m.Describe) -> m.Answer:
    """Send the choices of a result, with their places in the source."""
    job = m.DescribeRun(**session.source(command.key), question=session.question(), key=command.key)
    return await session.desk.do(job, answering(window, command.id))


async def judge(session: Session, window: Window, command: m.Judge) -> m.Answer:
    """Check whether a structure stands."""
    job = m.JudgeRun(**session.source(command.key), key=command.key, simulate=command.simulate)
    return await session.desk.do(job, answering(window, command.id))


async def show(session: Session, window: Window, command: m.Show) -> m.Answer:
    """Send the shape of a result."""

    def report(header: Any, payload: bytes) -> None:
        header.id = 0
        session.keep(command.key, command.detail, frame(msgspec.json.encode(header), payload))

    if command.detail == "picture":
        job = m.ShowRun(**session.source(command.key), key=command.key, detail="picture")
        return await session.desk.do(job, answering(window, command.id))
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
    job = m.FindDifference(**session.source(command.key), key=command.key)
    return await session.desk.do(job, answering(window, command.id))
