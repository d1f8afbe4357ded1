"""A client of a session in the same process: it sends a command and collects what the session answers.

A call waits for its end for at most `PATIENCE` seconds. Then its answer says that it is still at work, and `answer`
asks for its end. The state that windows share arrives as patches; the next answer tells the fields that have changed.
"""

from __future__ import annotations

import asyncio
import os
from collections import OrderedDict
from dataclasses import dataclass, field
from typing import Any, Union

import msgspec

from niwaki.agents import answers, tools
from niwaki.studio import messages as m
from niwaki.studio.frames import unpack
from niwaki.studio.session import Session, obey
from niwaki.studio.window import Window

#: Seconds that a call waits for its end.
PATIENCE = 0.9
#: Answers that can be asked for again.
KEPT = 64
#: Fields of the state that an answer does not tell by itself, because they are long and `look` has them.
QUIET = {"models", "targets", "undo", "redo", "interrupted", "sizes", "searching"}

_EVENT = msgspec.json.Decoder(Union[tuple(m.Event.__subclasses__())])  # noqa: UP007


@dataclass
class Reply:
    """An answer: a page of text, at most one picture, and whether the call failed."""

    text: str
    picture: bytes | None = None
    has_failed: bool = False


@dataclass
class Call:
    """A call and what has been answered so far."""

    number: int
    name: str
    lines: list[str] = field(default_factory=list)
    picture: bytes | None = None
    has_failed: bool = False
    is_told: bool = False
    ended: asyncio.Event = field(default_factory=asyncio.Event)


class Caller:
    """A client of a session.

    Parameters
    ----------
    session
        The session, whose loop runs in this thread.
    """

    def __init__(self, session: Session) -> None:
        self._session, self._window = session, Window()
        # Answers name files by their paths from the folder, as calls do.
        self._root = "" if session.root is None else f"{session.root.folder}{os.sep}"
        self._calls: OrderedDict[int, Call] = OrderedDict()
        self._count = 0
        self._changes: dict[str, Any] = {}
        self._reading: asyncio.Task[None] | None = None

    async def call(self, name: str, arguments: dict[str, Any]) -> Reply:
        """Call a tool, and wait for its answer for at most `PATIENCE` seconds."""
        if name == tools.ANSWER:
            return await self._again(arguments)
        self._count += 1
        call = Call(self._count, name)
        try:
            command = tools.command(name, arguments, call.number)
        except msgspec.ValidationError as error:
            return Reply(f"error bad-message\n{error}", has_failed=True)
        self._begin()
        self._calls[call.number] = call
        while len(self._calls) > KEPT:
            self._calls.popitem(last=False)
        self._session.start(self._obey(command))
        return await self._reply(call, 1)

    def end(self) -> None:
        """Stop reading the answers of the session."""
        self._session.windows.discard(self._window)
        if self._reading is not None:
            self._reading.cancel()

    async def _obey(self, command: m.AnyCommand) -> None:
        await obey(self._session, self._window, command)

    def _begin(self) -> None:
        if self._reading is None:
            self._session.windows.add(self._window)
            self._reading = asyncio.create_task(self._read())

    async def _read(self) -> None:
        async for data in self._window.waiting():
            payload = b""
            if isinstance(data, bytes):
                data, rest = unpack(data)
                payload = bytes(rest)
            self._note(_EVENT.decode(data), payload)

    def _note(self, event: m.Event, payload: bytes) -> None:
        """Add an event to the call that it answers, and the changes of the state to those of the next answer."""
        if isinstance(event, m.Patch):
            self._changes |= {name: value for name, value in event.changes.items() if name not in QUIET}
            return
        call = self._calls.get(event.id)
        if call is None:
            return
        if isinstance(event, m.Picture):
            call.picture = payload
        elif isinstance(event, m.Done | m.Failed):
            call.has_failed = isinstance(event, m.Failed)
            call.lines = answers.lines(event) + call.lines if call.has_failed else call.lines
            call.ended.set()
        elif isinstance(event, m.Difference):
            call.lines += answers.difference_lines(event, payload)
        elif not payload:
            call.lines += answers.lines(event)

    async def _again(self, arguments: dict[str, Any]) -> Reply:
        """Answer a call again: its end, or another page."""
        number, page = arguments.get("id"), arguments.get("page", 1)
        call = self._calls.get(number) if isinstance(number, int) else None
        if call is None or not isinstance(page, int):
            known = ", ".join(map(str, self._calls)) or "none"
            return Reply(
                f"error no-call\nthere is no call {number}; calls that are kept: {known}", has_failed=True
            )
        return await self._reply(call, page)

    async def _reply(self, call: Call, page: int) -> Reply:
        """Wait for the end of a call, and return a page of its answer."""
        try:
            await asyncio.wait_for(call.ended.wait(), PATIENCE)
        except TimeoutError:
            text = f"call {call.number}: {call.name} is at work{self._progress(call)}; ask: answer id={call.number}"
            return Reply(text)
        if not call.is_told:
            # What the session told all windows before the end of the call has arrived.
            call.is_told = True
            call.lines += self._changed_lines(call.has_failed)
        divided = answers.pages([line.replace(self._root, "") if self._root else line for line in call.lines])
        if not 1 <= page <= len(divided):
            return Reply(f"error no-page\nthe answer has {len(divided)} pages", has_failed=True)
        more = "" if page == len(divided) else f"; ask: answer id={call.number} page={page + 1}"
        pages = f", page {page} of {len(divided)}{more}" if len(divided) > 1 else ""
        state = "failed" if call.has_failed else "done"
        text = f"call {call.number}: {call.name} {state}{pages}\n{divided[page - 1]}".rstrip()
        return Reply(text, call.picture if page == 1 else None, call.has_failed)

    def _progress(self, call: Call) -> str:
        now = self._session.searching
        if now is None or call.name != "run":
            return ""
        return f" ({now.done} rounds{', best: ' + now.fit if now.fit else ''})"

    def _changed_lines(self, has_failed: bool) -> list[str]:
        """Return the fields of the state that have changed since the last answer; a failure tells its own problem."""
        changes, self._changes = self._changes, {}
        view = self._session.view()
        fields = {name: getattr(view, name) for name in changes if hasattr(view, name)}
        lines = answers.field_lines({name: value for name, value in fields.items() if name != "problem"})
        if fields.get("problem") is not None and not has_failed:
            lines += answers.problem_lines(fields["problem"])
        return lines
