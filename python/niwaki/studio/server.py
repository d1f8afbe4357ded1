"""The server of the studio: the page's files, the socket, uploads and exported files. It never imports a model.

GET  /            the page (and /app.js, /view.js, /app.css)
GET  /open        the link that the terminal shows (`niwaki.studio.security`)
GET  /socket      a websocket: JSON both ways, geometry as frames
POST /upload      a mesh or a drawing; its format is the suffix of `?name=ship.obj`
GET  /file/HASH   an exported file
     /mcp         the messages as tools, if `niwaki mcp` has started the server (`niwaki.agents`)
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import re
import sys
import tempfile
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from typing import Any

import msgspec
from starlette.applications import Starlette
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from niwaki.errors import NiwakiError
from niwaki.errors.files import PART
from niwaki.studio.messages import AnyCommand, Failed, Problem
from niwaki.studio.problems import problem
from niwaki.studio.security import Guard
from niwaki.studio.session import Session, obey
from niwaki.studio.window import Window

#: The page's files; no other file is served.
PAGE = {"/": "index.html"} | {f"/{name}": name for name in ("app.js", "view.js", "app.css", "inter.woff2")}
TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript",
    ".css": "text/css",
    ".woff2": "font/woff2",
}

#: Bytes of a command; bytes of an upload, and the seconds that it may take to arrive.
COMMAND, UPLOAD, PATIENCE = 1 << 20, 64 << 20, 60.0
#: Seconds that reading an upload may take.
READING = 60.0
#: Uploads that are received and read at one time.
READERS = 2
#: Windows and scripts at one time.
WINDOWS = 32

MESHES = (".obj", ".stl", ".ply", ".glb", ".gltf")
DRAWINGS = (".svg", ".png", ".webp", ".bmp", ".gif", ".tif", ".tiff", ".jpg", ".jpeg")
_decode = msgspec.json.Decoder(AnyCommand).decode


def application(
    session: Session, port: int, cookie: tuple[str, str] | None = None, further: Sequence[Route] = ()
) -> Guard:
    """Make the application, with a guard in front of it.

    Parameters
    ----------
    session
        The session.
    port
        The port of the server.
    cookie
        The name and the value of a known cookie.
    further
        Further routes, whose methods `niwaki.studio.security` lists.
    """

    async def page(request: Request) -> Response:
        name = PAGE[request.url.path]
        place = files("niwaki.studio").joinpath("page").joinpath(name)
        return Response(place.read_bytes(), media_type=TYPES[Path(name).suffix])

    async def file(request: Request) -> Response:
        name = request.path_params["hash"]
        folder = session.journal.folder / "files" / name
        is_stored = re.fullmatch("[0-9a-f]{64}", name) and folder.is_dir()
        # A partial file, left by a full disk, does not count.
        place = (
            next((path for path in folder.iterdir() if not path.name.startswith(PART[0])), None)
            if is_stored
            else None
        )
        if place is None:
            return PlainTextResponse("no such file\n", 404)
        return FileResponse(place, filename=place.name, content_disposition_type="attachment")

    async def upload(request: Request) -> Response:
        suffix = Path(request.query_params.get("name", "")).suffix.lower()
        if suffix not in MESHES + DRAWINGS:
            kinds = f"a mesh is one of {', '.join(MESHES)}, a drawing one of {', '.join(DRAWINGS)}"
            return _refused(415, "file-format", kinds)
        declared = request.headers.get("content-length", "0")
        if not declared.isdecimal() or len(declared) > 20 or int(declared) > UPLOAD:
            return _too_large()
        # Further uploads wait before their bytes are received.
        async with readers:
            return await receive(request, suffix)

    async def receive(request: Request, suffix: str) -> Response:
        body = bytearray()
        try:
            async with asyncio.timeout(PATIENCE):
                async for chunk in request.stream():
                    body += chunk
                    if len(body) > UPLOAD:
                        return _too_large()
        except TimeoutError:
            return _refused(408, "too-slow", f"the upload did not arrive within {PATIENCE:.0f} s")
        except ClientDisconnect:
            return _refused(400, "cut-short", "the upload was cut short")
        return await _read(bytes(body), suffix, session.journal.folder / "uploads")

    readers = asyncio.Semaphore(READERS)
    routes: list[Any] = [Route(path, page) for path in PAGE]
    routes += [Route("/file/{hash}", file), Route("/upload", upload, methods=["POST"])]
    routes += [WebSocketRoute("/socket", _socket(session)), *further]
    return Guard(
        Starlette(
            routes=routes, exception_handlers=dict.fromkeys((OSError, NiwakiError, Exception), _failed)
        ),
        port,
        cookie,
    )


async def _failed(request: Request, error: Exception) -> Response:
    """Answer a request that failed, for example because the disk is full."""
    failure = problem(error)
    return _refused(507 if isinstance(error, OSError | NiwakiError) else 500, failure.code, failure.text)


def _socket(session: Session) -> Any:
    """Make the function that serves a socket."""

    async def socket(connection: WebSocket) -> None:
        if len(session.windows) >= WINDOWS:
            await connection.close(1013)
            return
        await connection.accept()
        window = Window()
        work = {
            asyncio.create_task(_send(connection, window)),
            asyncio.create_task(_receive(connection, window, session)),
            asyncio.create_task(window.overrun.wait()),
        }
        try:
            await asyncio.wait(work, return_when=asyncio.FIRST_COMPLETED)
        finally:
            session.windows.discard(window)
            for task in work:
                task.cancel()
            await asyncio.gather(*work, return_exceptions=True)

    return socket


async def _receive(connection: WebSocket, window: Window, session: Session) -> None:
    """Carry out commands until the socket ends or sends a binary message."""
    while True:
        try:
            text = await connection.receive_text()
        except (WebSocketDisconnect, KeyError, RuntimeError):
            # The socket has ended, or the message is binary.
            return
        try:
            if len(text) > COMMAND:
                raise msgspec.ValidationError("the message is too long")
            command = _decode(text)
        except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
            window.tell(Failed(_id_of(text), Problem("bad-message", f"{error}")))
            continue
        await obey(session, window, command)


async def _send(connection: WebSocket, window: Window) -> None:
    async for data in window.waiting():
        if isinstance(data, str):
            await connection.send_text(data)
        else:
            await connection.send_bytes(data)


def _id_of(text: str) -> int:
    """Read the number of an invalid message; 0 without a number."""
    try:
        number = json.loads(text[:COMMAND])["id"]
        return number if isinstance(number, int) and not isinstance(number, bool) else 0
    except (ValueError, KeyError, TypeError, RecursionError):
        return 0


async def _read(body: bytes, suffix: str, folder: Path) -> Response:
    """Read a mesh or a drawing in a separate process, and store the result."""
    name = hashlib.sha256(body).hexdigest()
    with tempfile.TemporaryDirectory(dir=folder) as place:
        stored = ".stl" if suffix in MESHES else suffix
        source, sink = Path(place) / f"sent{suffix}", Path(place) / f"read{stored}"
        await asyncio.to_thread(source.write_bytes, body)
        command = (sys.executable, "-m", "niwaki.studio.worker.uploads", str(source), str(sink))
        pipe = asyncio.subprocess.PIPE
        reader = await asyncio.create_subprocess_exec(
            *command, stdin=asyncio.subprocess.DEVNULL, stdout=pipe, stderr=asyncio.subprocess.DEVNULL
        )
        try:
            async with asyncio.timeout(READING):
                output, _ = await reader.communicate()
        except TimeoutError:
            return _refused(422, "too-slow", f"reading the upload took more than {READING:.0f} s")
        finally:
            if reader.returncode is None:
                reader.kill()
                await reader.wait()
        if reader.returncode != 0 or not output.strip():
            return _refused(
                422, "mesh-too-large", "reading the upload needs more memory than an upload may use"
            )
        report = json.loads(output.splitlines()[-1])
        if "error" in report:
            return _refused(422, report.get("code", "file-unreadable"), report["error"])
        # The main file comes last: when it is there, the files beside it are there, too.
        for path in sorted(Path(place).glob("read.*"), key=lambda path: path == sink):
            path.rename(folder / path.name.replace("read.", f"{name}.", 1))
    # A mesh is the source of a target; a drawing has a reference, as a model has.
    address = (
        {"source": f"upload:{name}"} if stored == ".stl" else {"reference": f"drawing:upload:{name}{stored}"}
    )
    return JSONResponse({**address, **report})


def _refused(status: int, code: str, text: str) -> Response:
    return JSONResponse({"code": code, "text": text}, status)


def _too_large() -> Response:
    return _refused(413, "mesh-too-large", f"an upload may have at most {UPLOAD >> 20} MB")
