"""One open window or script: what waits to be sent to it.

Every message is sent in order, except the shapes and the progress of what is still moving: of those only the newest is
kept, so that a slow window never lags behind.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

import msgspec

from niwaki.studio.messages import Event, Picture, Regions, Shape

#: A window that has so many messages waiting is closed.
WAITING = 4_000


class Window:
    """The messages that wait for one window."""

    def __init__(self) -> None:
        self._waiting: dict[str | int, str | bytes] = {}
        self._count = 0
        self._some = asyncio.Event()
        self.is_overrun = False

    def tell(self, event: Event) -> None:
        """Send an event."""
        self.put(msgspec.json.encode(event).decode())

    def put(self, data: str | bytes, newest: str = "") -> None:
        """Send data; where `newest` names a kind, it takes the place of data of that kind that still waits."""
        self._count += 1
        if newest:
            self._waiting.pop(newest, None)
        self._waiting[newest or self._count] = data
        self.is_overrun = self.is_overrun or len(self._waiting) > WAITING
        self._some.set()

    async def waiting(self) -> AsyncIterator[str | bytes]:
        """What is to be sent, as it comes."""
        while not self.is_overrun:
            await self._some.wait()
            self._some.clear()
            while self._waiting:
                yield self._waiting.pop(next(iter(self._waiting)))


def newest(header: Shape | Picture | Regions) -> str:
    """The kind of a shape of which only the newest counts; empty for those that all count."""
    if header.what == "obstacle":
        return f"obstacle {header.number}"
    return header.what if header.what in ("best", "moving", "ghost") else ""
