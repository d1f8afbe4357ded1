"""A client of the studio for scripts: it sends the messages of the page and reads the same answers.

with niwaki.studio.connect("http://127.0.0.1:8000", key) as studio:
    studio.ask("model", reference="spaceship")
    studio.ask("run")
    print(studio.view["results"])
"""

from __future__ import annotations

import json
import time
from contextlib import ExitStack
from itertools import count
from types import TracebackType
from typing import Any, Self

import msgspec
from websockets.sync.client import ClientConnection
from websockets.sync.client import connect as dial

from niwaki.errors import NiwakiError
from niwaki.studio.frames import unpack
from niwaki.studio.messages import PROTOCOL, Command, Difference, Mask, Picture, Regions, Shape

#: Events with a payload of bytes; they do not answer a command.
FRAMES = ("shape", "picture", "regions", "mask")


class StudioError(NiwakiError):
    """A command that the studio refused or that failed, with the text that the page shows."""

    def __init__(self, code: str, text: str) -> None:
        super().__init__(code)
        self.code, self.text = code, text

    def render(self) -> str:
        """Return the text."""
        return self.text


class Studio:
    """A connection to a studio.

    Attributes
    ----------
    view : dict
        The state that every window shows, as of the last message that was read.
    shapes : list of (Shape, bytes)
        The shapes received so far.
    differences : list of (Difference, bytes)
        The differences from targets received so far.
    pictures : list of (Picture or Regions, bytes)
        The pictures of drawings and the regions received so far.
    masks : list of (Mask, bytes)
        The masks of sketches received so far.
    events : list of dict
        All events received so far.
    """

    def __init__(self, url: str, key: str) -> None:
        address = url.replace("http://", "ws://", 1).rstrip("/") + "/socket"
        headers = {"Authorization": f"Bearer {key}"}
        self._open = ExitStack()
        dialled = dial(address, additional_headers=headers, max_size=None, compression=None, proxy=None)
        self._socket: ClientConnection = self._open.enter_context(dialled)
        self._ids = count(1)
        self.view: dict[str, Any] = {}
        self.session = ""
        self.shapes: list[tuple[Shape, bytes]] = []
        self.differences: list[tuple[Difference, bytes]] = []
        self.pictures: list[tuple[Picture | Regions, bytes]] = []
        self.masks: list[tuple[Mask, bytes]] = []
        self.events: list[dict[str, Any]] = []
        self.ask("hello", protocol=PROTOCOL)

    def send(self, kind: str | Command, **fields: Any) -> int:
        """Send a command by its kind and its fields; return its number."""
        number = next(self._ids)
        data = msgspec.to_builtins(kind) if isinstance(kind, Command) else {"kind": kind, **fields}
        self._socket.send(json.dumps({**msgspec.to_builtins(data), "id": number}))
        return number

    def ask(self, kind: str | Command, timeout: float = 60.0, **fields: Any) -> dict[str, Any]:
        """Send a command and wait until it is done.

        Returns
        -------
        dict
            The last answer other than `done`; `done` if there is no other.

        Raises
        ------
        StudioError
            The studio refused the command, or it failed.
        """
        return self.wait(self.send(kind, **fields), timeout)

    def wait(self, number: int, timeout: float = 60.0) -> dict[str, Any]:
        """Read messages until a command is done."""
        answer: dict[str, Any] = {}
        end = time.monotonic() + timeout
        while True:
            event = self.read(end - time.monotonic())
            if event.get("id") != number or event["kind"] in FRAMES:
                continue
            if event["kind"] == "error":
                raise StudioError(event["problem"]["code"], event["problem"]["text"])
            if event["kind"] != "done":
                answer = event
            if event["kind"] in ("done", "state"):
                return answer or event

    def read(self, timeout: float = 60.0) -> dict[str, Any]:
        """Read one message.

        Raises
        ------
        TimeoutError
            No message arrived in time.
        """
        data = self._socket.recv(max(timeout, 0.0))
        if isinstance(data, bytes):
            header, payload = unpack(data)
            message = msgspec.json.decode(header, type=Shape | Difference | Picture | Regions | Mask)
            if isinstance(message, Shape):
                self.shapes.append((message, bytes(payload)))
            elif isinstance(message, Difference):
                self.differences.append((message, bytes(payload)))
            elif isinstance(message, Mask):
                self.masks.append((message, bytes(payload)))
            else:
                self.pictures.append((message, bytes(payload)))
            event: dict[str, Any] = msgspec.to_builtins(message)
        else:
            event = json.loads(data)
        if event["kind"] == "state":
            self.view, self.session = event["view"], event["session"]
        elif event["kind"] == "patch":
            self.view |= event["changes"]
        self.events.append(event)
        return event

    def close(self) -> None:
        """End the connection."""
        self._open.close()

    def __enter__(self) -> Self:
        """Return the connection."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the connection."""
        self.close()


def connect(url: str, key: str) -> Studio:
    """Connect to a studio.

    Parameters
    ----------
    url
        The address of the studio: `http://127.0.0.1:PORT`.
    key
        The studio's key; the file `key` in the session's folder has both.
    """
    return Studio(url, key)
