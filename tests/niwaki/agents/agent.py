"""A client that has only the protocol: a session in this process, and a loop that runs while a call waits."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from niwaki.agents.caller import Caller, Reply
from niwaki.agents.server import calling

#: The most bytes of a text and of a picture.
TEXT, PICTURE = 4_000, 100_000
#: The most times that a client asks for the end of a call.
ROUNDS = 200


class Agent:
    """A client of a folder.

    Attributes
    ----------
    sizes : list of (str, int, int)
        The tool, the bytes of the text and of the picture of every answer.
    """

    def __init__(self, runner: asyncio.Runner, caller: Caller, folder: Path) -> None:
        self.runner, self.caller, self.folder = runner, caller, folder
        self.sizes: list[tuple[str, int, int]] = []

    def once(self, tool: str, **arguments: object) -> Reply:
        """Send one call, and return its answer as it is."""
        reply = self.runner.run(self.caller.call(tool, arguments))
        size = len(reply.text.encode()), len(reply.picture or b"")
        assert size[0] <= TEXT and size[1] <= PICTURE, (tool, size)
        # What `answer` returns is the answer of an earlier call.
        named = re.match(r"call \d+: (\w+)", reply.text)
        self.sizes.append((tool if named is None else named[1], *size))
        return reply

    def call(self, tool: str, **arguments: object) -> Reply:
        """Send a call, and ask for its answer until the call has ended."""
        reply = self.once(tool, **arguments)
        for _ in range(ROUNDS):
            match = re.match(r"call (\d+): \w+ is at work", reply.text)
            if match is None:
                return reply
            reply = self.once("answer", id=int(match[1]))
        raise AssertionError(reply.text)

    def done(self, tool: str, **arguments: object) -> str:
        """Send a call that must not fail; return its text."""
        reply = self.call(tool, **arguments)
        assert not reply.has_failed, reply.text
        return reply.text

    def failed(self, tool: str, **arguments: object) -> str:
        """Send a call that must fail; return its text."""
        reply = self.call(tool, **arguments)
        assert reply.has_failed, reply.text
        return reply.text


@contextmanager
def agent(folder: Path) -> Iterator[Agent]:
    """Open a client of a folder; its session is in `folder/studio-session`."""
    with asyncio.Runner() as runner:
        opened = calling(folder, folder / "studio-session")
        caller = runner.run(opened.__aenter__())
        try:
            yield Agent(runner, caller, folder)
        finally:
            runner.run(opened.__aexit__(None, None, None))
