"""The loop that serves a session on loopback until it is stopped."""

from __future__ import annotations

import asyncio
import contextlib
import os
import socket
import sys
import webbrowser
from collections.abc import Callable, Sequence
from contextlib import AbstractAsyncContextManager, AsyncExitStack
from pathlib import Path
from typing import Any, ClassVar

import uvicorn
from starlette.routing import Route
from uvicorn.protocols.http.h11_impl import H11Protocol
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from watchfiles import awatch

from niwaki.errors import InputError, NiwakiError
from niwaki.errors.files import write_whole
from niwaki.errors.folders import held_folder
from niwaki.inputs import bytes_of
from niwaki.studio.security import Guard
from niwaki.studio.server import COMMAND, application
from niwaki.studio.session import Session, begin, reload

resource: Any
try:
    import resource
except ImportError:
    resource = None

#: The session's file with its port and its cookie, by which an open page comes back after a restart.
COOKIE = "cookie"
#: Connections at one time, and seconds in which each has to send its first request.
CONNECTIONS, FIRST_WORD = 256, 15.0
#: Unread bytes of a socket, beside one message; seconds to read the rest after its end.
UNREAD, GRACE = 1 << 20, 5.0


class Patient(H11Protocol):
    """A connection that closes if no request arrives for long.

    If there are too many connections, the connection that has been silent longest is closed: a client that sends its
    request at once gets an answer.
    """

    #: Connections without a request so far, in the order of arrival; some may have sent a request since.
    _silent: ClassVar[dict[Patient, None]] = {}

    def connection_made(self, transport: Any) -> None:
        """Count the connection, and wait for its first request."""
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
        """Whether no request has arrived so far."""
        return getattr(self, "cycle", None) is None and not self.transport.is_closing()

    def _lose_patience(self) -> None:
        if self._is_silent:
            self.transport.close()

    def connection_lost(self, exc: Exception | None) -> None:
        """Stop waiting for a request."""
        self._patience.cancel()
        self._silent.pop(self, None)
        super().connection_lost(exc)

    def handle_websocket_upgrade(self, event: Any) -> None:
        """Stop waiting: a socket may be silent."""
        self._patience.cancel()
        self._silent.pop(self, None)
        super().handle_websocket_upgrade(event)


class Reading(WebSocketsSansIOProtocol):
    """A socket that closes, unsent messages included, if its other end does not read."""

    def handle_ping(self) -> None:
        """Answer a ping; close the socket if too many answers are unread."""
        super().handle_ping()
        if self.transport.get_write_buffer_size() > UNREAD:
            self.transport.abort()

    def keepalive_timeout(self) -> None:
        """Close a socket that has not answered for long."""
        super().keepalive_timeout()
        self.transport.abort()

    async def run_asgi(self) -> None:
        """Serve the socket; drop unread messages a while after its end."""
        await super().run_asgi()
        self.loop.call_later(GRACE, self.transport.abort)


def listening(port: int) -> socket.socket:
    """Open a socket on loopback; port 0 takes a free port."""
    # asyncio sends small messages at once (TCP_NODELAY) only where the protocol is named.
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind(("127.0.0.1", port))
    except (OSError, OverflowError) as error:
        listener.close()
        raise InputError(
            "bad-setting",
            name="--port",
            found=str(port),
            expected=f"a free port ({error.strerror})"
            if isinstance(error, OSError)
            else "a port from 0 to 65535",
            suggestion="another port, or leave out `--port`",
        ) from error
    return listener


#: Opens what a server serves beside the page: routes, for as long as the server runs.
Beside = Callable[[Session], AbstractAsyncContextManager[Sequence[Route]]]


def serve(
    models: list[str],
    folder: Path,
    port: int = 0,
    browser: bool = True,
    trust: bool = False,
    root: Path | None = None,
    beside: Beside | None = None,
) -> None:
    """Serve a session until Ctrl-C.

    Parameters
    ----------
    models
        References of models in files: `file.py`, `file.py:function`.
    folder
        The folder of the session; a session that is there resumes.
    port
        The port; 0 for a free port.
    browser
        Whether to open the page.
    trust
        Whether unchanged files that stored runs name may be run for their host functions.
    root
        The folder below which commands may name, read and write files; None for no folder.
    beside
        Further routes of the server.

    Raises
    ------
    FileError
        `folder-in-use`: another studio uses this session.
    """
    _allow_files()
    with contextlib.suppress(KeyboardInterrupt), held_folder(folder):
        files = [_absolute(reference) for reference in models]
        asyncio.run(_serve(Session(folder, files, trust, root), folder, port, browser, beside))


def _allow_files() -> None:
    """Raise the limit of open files, so that all connections fit; Windows has no such limit."""
    if resource is None:
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(soft, min(hard, 4096)), hard))


def _absolute(reference: str) -> str:
    """Return a reference with the absolute path of its file."""
    place, colon, name = reference.rpartition(":")
    if not place.endswith(".py"):
        place, colon, name = reference, "", ""
    if not place.endswith(".py") or not Path(place).is_file():
        raise InputError("unknown-model", name=reference, reason=f"there is no file {Path(place).absolute()}")
    return f"{Path(place).resolve()}{colon}{name}"


async def _serve(session: Session, folder: Path, port: int, browser: bool, beside: Beside | None) -> None:
    async with AsyncExitStack() as stack:
        stack.push_async_callback(session.end)
        listener = _listening_again(port, folder)
        port = listener.getsockname()[1]
        routes = () if beside is None else await stack.enter_async_context(beside(session))
        guard = application(session, port, _stored_cookie(folder, port), routes)
        write_whole(folder / COOKIE, f"{port} {guard.cookie_name} {guard.cookie}\n".encode(), private=True)
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
        watching = session.start(_watch(session, session.files))
        beginning = asyncio.create_task(begin(session))
        telling = asyncio.create_task(_tell(guard, port, browser))
        try:
            await server.serve(sockets=[listener])
        finally:
            for task in (watching, beginning, telling):
                task.cancel()


def _listening_again(port: int, folder: Path) -> socket.socket:
    """Open a socket; if no port is given, at the session's last port, so that an open page finds the studio again."""
    stored = _stored(folder)
    if port == 0 and stored is not None:
        with contextlib.suppress(InputError):
            return listening(stored[0])
    return listening(port)


def _stored(folder: Path) -> tuple[int, str, str] | None:
    """Read the port and the cookie of the session's last studio; None without them."""
    try:
        words = bytes_of(folder / COOKIE, "session").decode().split()
        port = int(words[0])
    except (NiwakiError, ValueError, IndexError):
        return None
    is_whole = len(words) == 3 and 0 < port < 65536 and words[1].startswith(f"niwaki_{port}_")
    return (port, words[1], words[2]) if is_whole and len(words[2]) >= 32 else None


def _stored_cookie(folder: Path, port: int) -> tuple[str, str] | None:
    """Return the cookie of the session's last studio, if it had this port."""
    stored = _stored(folder)
    return stored[1:] if stored is not None and stored[0] == port else None


async def _tell(guard: Guard, port: int, browser: bool) -> None:
    """Print the link, and a new link after each use."""
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
    """Reload model files that change. Their folders are watched, because editors save by renaming."""
    paths = {Path(reference.rpartition(":")[0] or reference) for reference in models}
    if not paths:
        return
    async for changes in awatch(*{path.parent for path in paths}, debounce=100, step=20, recursive=False):
        changed = {Path(place) for _, place in changes} & paths
        if changed:
            # As a task of its own: if the file changes while it loads, its newest state is loaded instead.
            session.start(reload(session, changed))
