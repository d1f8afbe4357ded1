"""The queue of messages to one window or script.

Messages are sent in order. Of shapes that move and of progress only the newest is kept, so that a slow window does not
lag behind.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import msgspec

from niwaki.studio.messages import Event, Mask, Picture, Regions, Shape

#: Messages, and bytes of more than one message, that may wait; with more, the window is closed.
WAITING, ROOM = 4_000, 64 << 20


class Window:
    """The queue of messages to one window.

    Attributes
    ----------
    overrun : asyncio.Event
        Set when too much waits because the window does not read; its messages are then dropped.
    """

    def __init__(self) -> None:
        self._waiting: dict[str | int, str | bytes] = {}
        self._count = self._bytes = 0
        self._some = asyncio.Event()
        self.overrun = asyncio.Event()

    def tell(self, event: Event) -> None:
        """Send an event."""
        self.put(msgspec.json.encode(event).decode())

    def put(self, data: str | bytes, newest: str = "") -> None:
        """Send data. If `newest` names a kind, the data replaces waiting data of that kind."""
        if self.overrun.is_set():
            return
        self._count += 1
        if newest:
            self._bytes -= len(self._waiting.pop(newest, ""))
        self._waiting[newest or self._count] = data
        self._bytes += len(data)
        if len(self._waiting) > WAITING or (self._bytes > ROOM and len(self._waiting) > 1):
            self._waiting.clear()
            self.overrun.set()
        self._some.set()

    async def waiting(self) -> AsyncIterator[str | bytes]:
        """Go through the data to send, for as long as the window reads."""
        while not self.overrun.is_set():
            await self._some.wait()
            self._some.clear()
            while self._waiting:
                data = self._waiting.pop(next(iter(self._waiting)))
                self._bytes -= len(data)
                yield data


def newest(header: Shape | Picture | Regions | Mask) -> str:
    """Return the kind of a shape of which only the newest counts; empty if all of them count."""
    if isinstance(header, Mask):
        return "mask"
    if isinstance(header, Shape) and header.role in ("obstacle", "glimpse"):
        return f"{header.role} {header.source if header.role == 'glimpse' else header.number}"
    return header.role if header.role in ("best", "moving", "ghost", "prior") else ""
