"""Serving a session on loopback until it is stopped."""

from __future__ import annotations

import asyncio
import contextlib
import os
import socket
import sys
import webbrowser
from pathlib import Path
from typing import Any, ClassVar

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from watchfiles import awatch

from niwaki.errors import InputError
from niwaki.errors.files import write_whole
from niwaki.errors.folders import held_folder
from niwaki.studio.security import Guard
from niwaki.studio.server import COMMAND, application
from niwaki.studio.session import Session, begin, reload

resource: Any
try:
    import resource
except ImportError:
    resource = None

#: Connections at one time, and seconds in which each has to ask something.
CONNECTIONS, FIRST_WORD = 256, 15.0
#: Bytes of a socket that wait for its other end, beside one message; seconds to read the rest after its end.
UNREAD, GRACE = 1 << 20, 5.0


class Patient(H11Protocol):
    """A connection that is closed when it asks nothing for long.

    Where there are too many, that goes which has been silent for longest: whoever asks at once is answered.
    """

    #: Those that have asked nothing, in the order in which they came; some have meanwhile asked.
    _silent: ClassVar[dict[Patient, None]] = {}

    def connection_made(self, transport: Any) -> None:
        """Count it, and wait for its first request."""
        super().connection_made(transport)
        self._silent[self] = None
        self._patience = self.loop.call_later(FIRST_WORD, self._lose_patience)
        while len(self.connections) > CONNECTIONS:
            oldest = next(iter(self._silent))
            del self._silent[oldest]
            if oldest._is_silent:
                oldest.transport.close()
                break

    @property
    def _is_silent(self) -> bool:
        """Whether it has asked nothing so far."""
        return getattr(self, "cycle", None) is None and not self.transport.is_closing()

    def _lose_patience(self) -> None:
        if self._is_silent:
            self.transport.close()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait no more."""
        self._patience.cancel()
        self._silent.pop(self, None)
        super().connection_lost(exc)

    def handle_websocket_upgrade(self, event: Any) -> None:
        """A socket may be silent."""
        self._patience.cancel()
        self._silent.pop(self, None)
        super().handle_websocket_upgrade(event)


class Reading(WebSocketsSansIOProtocol):
    """A socket that ends, with what it should still be sent, when its other end does not read."""

    def handle_ping(self) -> None:
        """Answer; answers that nobody reads are not kept."""
        super().handle_ping()
        if self.transport.get_write_buffer_size() > UNREAD:
            self.transport.abort()

    def keepalive_timeout(self) -> None:
        """It has not answered for long."""
        super().keepalive_timeout()
        self.transport.abort()

    async def run_asgi(self) -> None:
        """Serve it; what it has not read a while after that is dropped."""
        await super().run_asgi()
        self.loop.call_later(GRACE, self.transport.abort)


def listening(port: int) -> socket.socket:
    """A socket on loopback; port 0 takes a free one."""
    # asyncio sends small messages at once (TCP_NODELAY) only where the protocol is named.
    found = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind(("127.0.0.1", port))
    except (OSError, OverflowError) as error:
        found.close()
        raise InputError(
            "bad-setting",
            name="--port",
            found=str(port),
            expected=f"a free port ({error.strerror})"
            if isinstance(error, OSError)
            else "a port from 0 to 65535",
            suggestion="another port, or leave it out",
        ) from error
    return found


def serve(models: list[str], folder: Path, port: int = 0, browser: bool = True, trust: bool = False) -> None:
    """Serve a session until Ctrl-C.

    Parameters
    ----------
    models
        References of models in files: `file.py`, `file.py:function`.
    folder
        Where the session is stored; one that is there goes on.
    port
        0 for a free one.
    browser
        Whether to open the page.
    trust
        Whether files that stored runs name may be run for their host functions, where they have not changed.

    Raises
    ------
    FileError
        `folder-in-use`: another studio has this session.
    """
    _allow_files()
    with contextlib.suppress(KeyboardInterrupt), held_folder(folder):
        asyncio.run(_serve([_whole(one) for one in models], folder, port, browser, trust))


def _allow_files() -> None:
    """Let this process have as many connections as it takes; Windows has no such limit."""
    if resource is None:
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(hard, 4096)), hard))


def _whole(reference: str) -> str:
    """A reference with the whole path of its file."""
    place, colon, name = reference.rpartition(":")
    if not place.endswith(".py"):
        place, colon, name = reference, "", ""
    if not place.endswith(".py") or not Path(place).is_file():
        raise InputError("unknown-model", name=reference, reason=f"there is no file {Path(place).absolute()}")
    return f"{Path(place).resolve()}{colon}{name}"


async def _serve(models: list[str], folder: Path, port: int, browser: bool, trust: bool) -> None:
    session = Session(folder, models, trust)
    door = listening(port)
    port = door.getsockname()[1]
    guard = application(session, port)
    config = uvicorn.Config(
        guard,
        http=Patient,
        ws=Reading,
        ws_max_size=COMMAND,
        ws_per_message_deflate=False,
        log_level="error",
        access_log=False,
        lifespan="off",
        timeout_keep_alive=10,
        timeout_graceful_shutdown=2,
        server_header=False,
        date_header=False,
    )
    server = uvicorn.Server(config)
    write_whole(folder / "key", f"http://127.0.0.1:{port} {guard.key}\n".encode(), private=True)
    watching = session.start(_watch(session, models))
    beginning = asyncio.create_task(begin(session))
    telling = asyncio.create_task(_tell(guard, port, browser))
    try:
        await server.serve(sockets=[door])
    finally:
        for task in (watching, beginning, telling):
            task.cancel()
        await session.end()


async def _tell(guard: Guard, port: int, browser: bool) -> None:
    """Print the link, and the next one whenever it was used."""
    shown = ""
    while True:
        if guard.token != shown:
            first, shown = not shown, guard.token
            link = f"http://127.0.0.1:{port}/open?token={shown}"
            print(f"the studio is at  {link}" if first else f"another window:   {link}", flush=True)
            if first and browser and not _headless():
                webbrowser.open(link)
        await asyncio.sleep(0.1)


def _headless() -> bool:
    """Whether there is no screen to open a browser on."""
    return sys.platform.startswith("linux") and not ({"DISPLAY", "WAYLAND_DISPLAY"} & set(os.environ))


async def _watch(session: Session, models: list[str]) -> None:
    """Tell the session of model files that change: their folders are watched, as editors save by renaming."""
    paths = {Path(one.rpartition(":")[0] or one) for one in models}
    if not paths:
        return
    async for changes in awatch(*{path.parent for path in paths}, debounce=100, step=20, recursive=False):
        changed = {Path(place) for _, place in changes} & paths
        if changed:
            # Beside this: a file that still loads is left for its newest state.
            session.start(reload(session, changed))
