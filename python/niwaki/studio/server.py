"""The server: the page's files, the socket, uploads and exported files. It never imports a model.

GET  /            the page (and /app.js, /view.js, /app.css)
GET  /open        the link that the terminal shows (`niwaki.studio.security`)
GET  /socket      a websocket: JSON both ways, geometry as frames
POST /upload      a mesh or a drawing; `?name=ship.obj` says its format
GET  /file/HASH   what was exported
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import re
import sys
import tempfile
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
from niwaki.studio.refused import problem
from niwaki.studio.security import Guard
from niwaki.studio.session import Session, obey
from niwaki.studio.window import Window

#: The page's files: no other path is read.
PAGE = {"/": "index.html"} | {f"/{name}": name for name in ("app.js", "view.js", "app.css", "inter.woff2")}
TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript",
    ".css": "text/css",
    ".woff2": "font/woff2",
}

#: Bytes of a command; of a mesh that is sent, and how many seconds may pass while it comes.
COMMAND, UPLOAD, PATIENCE = 1 << 20, 64 << 20, 60.0
#: Seconds in which a mesh has to be read.
READING = 60.0
#: Meshes and drawings that are taken and read at one time.
READERS = 2
#: Windows and scripts at one time.
WINDOWS = 32

MESHES = (".obj", ".stl", ".ply", ".glb", ".gltf")
DRAWINGS = (".svg", ".png", ".webp", ".bmp", ".gif", ".tif", ".tiff", ".jpg", ".jpeg")
_decode = msgspec.json.Decoder(AnyCommand).decode


def application(session: Session, port: int) -> Guard:
    """The application, guarded."""

    async def page(request: Request) -> Response:
        name = PAGE[request.url.path]
        place = files("niwaki.studio").joinpath("page").joinpath(name)
        return Response(place.read_bytes(), media_type=TYPES[Path(name).suffix])

    async def file(request: Request) -> Response:
        name = request.path_params["hash"]
        folder = session.journal.folder / "files" / name
        known = re.fullmatch("[0-9a-f]{64}", name) and folder.is_dir()
        # A part of a file that a full disk has stopped is none.
        place = (
            next((one for one in folder.iterdir() if not one.name.startswith(PART[0])), None)
            if known
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
        # Those that come meanwhile wait, and their bytes with them.
        async with readers:
            return await taken(request, suffix)

    async def taken(request: Request, suffix: str) -> Response:
        body = bytearray()
        try:
            async with asyncio.timeout(PATIENCE):
                async for chunk in request.stream():
                    body += chunk
                    if len(body) > UPLOAD:
                        return _too_large()
        except TimeoutError:
            return _refused(408, "too-slow", f"it did not arrive within {PATIENCE:.0f} s")
        except ClientDisconnect:
            return _refused(400, "cut-short", "it was cut short")
        return await _read(bytes(body), suffix, session.journal.folder / "uploads")

    readers = asyncio.Semaphore(READERS)
    routes: list[Any] = [Route(path, page) for path in PAGE]
    routes += [Route("/file/{hash}", file), Route("/upload", upload, methods=["POST"])]
    routes.append(WebSocketRoute("/socket", _socket(session)))
    return Guard(
        Starlette(
            routes=routes, exception_handlers=dict.fromkeys((OSError, NiwakiError, Exception), _failed)
        ),
        port,
    )


async def _failed(request: Request, error: Exception) -> Response:
    """The answer to a request whose work failed, such as by a full disk."""
    told = problem(error)
    return _refused(507 if isinstance(error, OSError | NiwakiError) else 500, told.code, told.text)


def _socket(session: Session) -> Any:
    """The end of a socket."""

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
            for one in work:
                one.cancel()
            await asyncio.gather(*work, return_exceptions=True)

    return socket


async def _receive(connection: WebSocket, window: Window, session: Session) -> None:
    """Carry out what comes, until the end or a message that is none."""
    while True:
        try:
            text = await connection.receive_text()
        except (WebSocketDisconnect, KeyError, RuntimeError):
            # The end, or a binary message.
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
    """The number of a message that is refused, where it has one."""
    try:
        found = json.loads(text[:COMMAND])
        return found["id"] if isinstance(found["id"], int) and not isinstance(found["id"], bool) else 0
    except (ValueError, KeyError, TypeError, RecursionError):
        return 0


async def _read(body: bytes, suffix: str, folder: Path) -> Response:
    """Read a mesh or a drawing in a process of its own, and keep what it has read."""
    name = hashlib.sha256(body).hexdigest()
    with tempfile.TemporaryDirectory(dir=folder) as place:
        kept = ".stl" if suffix in MESHES else suffix
        source, sink = Path(place) / f"sent{suffix}", Path(place) / f"read{kept}"
        await asyncio.to_thread(source.write_bytes, body)
        command = (sys.executable, "-m", "niwaki.studio.worker.uploads", str(source), str(sink))
        pipe = asyncio.subprocess.PIPE
        reader = await asyncio.create_subprocess_exec(
            *command, stdin=asyncio.subprocess.DEVNULL, stdout=pipe, stderr=asyncio.subprocess.DEVNULL
        )
        try:
            async with asyncio.timeout(READING):
                said, _ = await reader.communicate()
        except TimeoutError:
            return _refused(422, "too-slow", f"it could not be read within {READING:.0f} s")
        finally:
            if reader.returncode is None:
                reader.kill()
                await reader.wait()
        if reader.returncode != 0 or not said.strip():
            return _refused(
                422, "mesh-too-large", "it could not be read within the memory that a mesh may take"
            )
        found = json.loads(said.splitlines()[-1])
        if "error" in found:
            return _refused(422, found.get("code", "file-unreadable"), found["error"])
        # What was asked for last: what is beside it is there when it is.
        for one in sorted(Path(place).glob("read.*"), key=lambda one: one == sink):
            one.rename(folder / one.name.replace("read.", f"{name}.", 1))
    # A mesh is a target's source; a drawing is chosen as models are.
    sent = {"source": f"upload:{name}"} if kept == ".stl" else {"reference": f"drawing:upload:{name}{kept}"}
    return JSONResponse({**sent, **found})


def _refused(status: int, code: str, text: str) -> Response:
    return JSONResponse({"code": code, "text": text}, status)


def _too_large() -> Response:
    return _refused(413, "mesh-too-large", f"a mesh that is sent has at most {UPLOAD >> 20} MB")
