"""One open window or script: what waits to be sent to it.

Every message is sent in order, except the shapes and the progress of what is still moving: of those only the newest is
kept, so that a slow window never lags behind.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import msgspec

from niwaki.studio.messages import Event, Picture, Regions, Shape

#: A window that has so many messages, or more than one and so many bytes, waiting is closed.
WAITING, ROOM = 4_000, 64 << 20


class Window:
    """The messages that wait for one window.

    Attributes
    ----------
    overrun : asyncio.Event
        Set when too much waits: the window does not read. Nothing is kept for it any more.
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
        """Send data; where `newest` names a kind, it takes the place of data of that kind that still waits."""
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
        """What is to be sent, as it comes, for as long as the window reads it."""
        while not self.overrun.is_set():
            await self._some.wait()
            self._some.clear()
            while self._waiting:
                data = self._waiting.pop(next(iter(self._waiting)))
                self._bytes -= len(data)
                yield data


def newest(header: Shape | Picture | Regions) -> str:
    """The kind of a shape of which only the newest counts; empty for those that all count."""
    if header.what == "obstacle":
        return f"obstacle {header.number}"
    return header.what if header.what in ("best", "moving", "ghost") else ""
