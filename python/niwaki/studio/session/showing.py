"""Choices and shapes of a result, how it differs from what is wanted, whether it stands: for the window that asks."""

from __future__ import annotations

from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.frames import frame
from niwaki.studio.session.state import Session
from niwaki.studio.window import Window


async def describe(session: Session, window: Window, command: m.Describe) -> m.Answer:
    """The choices of a result, with places in the source."""

    def report(found: Any, payload: bytes) -> None:
        window.tell(msgspec.structs.replace(found, id=command.id))

    job = m.DescribeRun(**session.source(command.key), question=session.question(), key=command.key)
    return await session.desk.do(job, report)


async def judge(session: Session, window: Window, command: m.Judge) -> m.Answer:
    """Whether a structure stands."""

    def report(found: Any, payload: bytes) -> None:
        window.tell(msgspec.structs.replace(found, id=command.id))

    job = m.JudgeRun(**session.source(command.key), key=command.key, simulate=command.simulate)
    return await session.desk.do(job, report)


async def show(session: Session, window: Window, command: m.Show) -> m.Answer:
    """The shape of a result."""

    def report(found: Any, payload: bytes) -> None:
        found.id = 0
        session.keep(command.key, command.detail, frame(msgspec.json.encode(found), payload))

    source, answer = session.source(command.key), m.Answer()
    if session.shape(command.key, command.detail) is None:
        job = m.ShowRun(**source, key=command.key, detail=command.detail)
        answer = await session.desk.do(job, report)
    found = session.shape(command.key, command.detail)
    if found is not None:
        window.put(found)
    return answer


async def show_difference(session: Session, window: Window, command: m.ShowDifference) -> m.Answer:
    """Where a result differs from what is wanted."""

    def report(found: Any, payload: bytes) -> None:
        found.id = command.id
        window.put(frame(msgspec.json.encode(found), payload))

    job = m.FindDifference(**session.source(command.key), key=command.key)
    return await session.desk.do(job, report)
