"""Every command gets an answer, also after failures; silent clients and slow readers do not block other clients."""

from __future__ import annotations

import asyncio
import json
import socket
import tracemalloc
from pathlib import Path
from typing import Any, get_args

import pytest

pytest.importorskip("starlette")

import msgspec
from niwaki import studio
from niwaki.studio import messages as m
from niwaki.studio import server, serving, window
from niwaki.studio.session import Session, dispatch, obey
from niwaki.studio.window import Window
from studio_process import fetch

KEY = {"run": 0}
FIELDS: dict[type, dict[str, Any]] = {
    m.Hello: {"protocol": 1},
    m.ChooseModel: {"reference": "spaceship"},
    m.SetAsk: {"ask": {"floor": 0.0}},
    m.Set: {"arguments": {"a": 1}},
    m.HoldParts: {"parts": ["a"]},
    m.Reroll: {"part": "a"},
    m.Choose: {"address": "a", "value": 1.0},
    m.Drag: {"part": "a", "to": [0, 0, 0]},
    m.Rewrite: {"difference": ""},
    m.Read: {"path": "a.md"},
    m.Write: {"path": "a.md", "text": ""},
    m.Explain: {"choice": "a"},
    m.Fit: {"reference": "a.py:f", "target": {"source": "box"}},
    m.Export: {"key": KEY, "format": "glb"},
} | dict.fromkeys((m.Describe, m.Show, m.ShowDifference, m.Pick, m.Star, m.Judge), {"key": KEY})
COMMANDS = get_args(m.AnyCommand)


def command(kind: type, number: int) -> Any:
    fields = {"kind": kind.__struct_config__.tag, "id": number, **FIELDS.get(kind, {})}
    return msgspec.json.decode(json.dumps(fields), type=m.AnyCommand)


def events(window_: Window) -> list[dict]:
    return [json.loads(data) for data in window_._waiting.values() if isinstance(data, str)]


@pytest.mark.parametrize(
    "error", [ZeroDivisionError("x"), OSError(28, "No space left on device"), RecursionError()]
)
@pytest.mark.parametrize("is_late", [False, True], ids=["at-once", "late"])
def test_a_command_that_fails_is_answered_with_why(tmp_path, monkeypatch, error, is_late):
    """Try each kind of command; it fails at once or as a task."""

    def at_once(*_: Any) -> None:
        raise error

    async def late(*_: Any) -> None:
        await asyncio.sleep(0)
        raise error

    async def work() -> None:
        session, client = Session(tmp_path, []), Window()
        session.ready.set()
        fails = late if is_late else at_once
        monkeypatch.setattr(dispatch, "COMMANDS", dict.fromkeys(dispatch.COMMANDS, fails))
        for number, kind in enumerate(COMMANDS, 1):
            await obey(session, client, command(kind, number))
        await asyncio.gather(*session._tasks)
        answers = {event["id"]: event for event in events(client)}
        assert set(answers) == set(range(1, len(COMMANDS) + 1))
        for number, kind in enumerate(COMMANDS, 1):
            assert answers[number]["kind"] == ("state" if kind is m.Hello else "error")
            assert kind is m.Hello or answers[number]["problem"]["text"]
        await session.end()

    asyncio.run(work())


def test_work_beside_commands_that_fails_is_told_to_every_window(tmp_path, monkeypatch):
    async def fails(*_: Any) -> None:
        raise OSError(28, "No space left on device", "x")

    async def work() -> None:
        session, windows = Session(tmp_path, []), [Window(), Window()]
        session.ready.set()
        for each in windows:
            await obey(session, each, m.Hello(protocol=m.PROTOCOL, id=1))
        session.start(fails())
        await asyncio.gather(*session._tasks)
        for each in windows:
            event = events(each)[-1]
            assert (event["kind"], event["id"]) == ("error", 0) and "No space left" in event["problem"][
                "text"
            ]
        await session.end()

    asyncio.run(work())


def test_a_failed_report_ends_the_worker_process(tmp_path):
    """The process is ended, so that its further reports reach no other job."""
    from niwaki.studio.process import Worker

    async def work() -> None:
        worker = Worker()
        try:
            assert (await worker.do(m.ListModels(files=[]))).models

            def report(*_: Any) -> None:
                raise ZeroDivisionError

            with pytest.raises(ZeroDivisionError):
                ask = m.Question("spaceship", {}, m.Ask(), m.Settings())
                await worker.do(m.Ghost(question=ask), report)
            assert worker.pid is None
            answer = await worker.do(m.ListModels(files=[]))
            assert answer.models and answer.problem is None
        finally:
            await worker.kill()

    asyncio.run(work())


# ---- over the wire


@pytest.mark.parametrize(
    "fields",
    [
        {"kind": "describe", "key": {"run": 10**300}},
        {"kind": "describe", "key": {"run": 2**53 - 1}},
        {"kind": "show", "key": {"run": 0, "number": 2**53 - 1}},
        {"kind": "export", "key": {"run": 10**18, "number": 10**18}, "format": "glb"},
        {"kind": "star", "key": {"run": 10**40}},
        {"kind": "set", "arguments": {"a": 10**400}},
        {"kind": "set", "arguments": {"a": [[[[]]]]}},
        {"kind": "model", "reference": "\x00"},
        {"kind": "model", "reference": "drawing:upload:" + "0" * 64 + ".svg"},
        {"kind": "rewrite", "difference": "x" * 100_000},
        {"kind": "choose", "address": "\x00", "value": 1e308},
        {"kind": "drag", "part": "", "to": [1e9, -1e9, 0.0]},
        {"kind": "reroll", "part": "[", "count": 48},
        {"kind": "hold", "parts": ["*"] * 10_000},
    ],
)
def test_a_strange_command_is_answered(served, connected, fields):
    number = connected.send(
        fields["kind"], **{name: value for name, value in fields.items() if name != "kind"}
    )
    while True:
        event = connected.read(30)
        if event.get("id") == number and event["kind"] in ("error", "done"):
            break
    assert event["kind"] == "done" or event["problem"]["text"]
    # The session still works, for this window and for a new window.
    connected.ask("set", settings={"count": 3})
    with studio.connect(served.url, served.key) as other:
        assert other.view["settings"]["count"] == 3
    connected.ask("model", reference="spaceship")


def test_half_sent_requests_keep_nobody_out(served, connected):
    """With more silent connections than the limit, a complete request still gets an answer at once."""
    silent = []
    try:
        for _ in range(serving.CONNECTIONS + 40):
            link = socket.create_connection(("127.0.0.1", served.port), 5)
            link.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.")
            silent.append(link)
        for _ in range(3):
            assert fetch(served, "/").startswith(b"<!doctype html>")
            with studio.connect(served.url, served.key) as other:
                assert other.view
        # The open window stays connected.
        connected.ask("set", settings={"count": 4})
    finally:
        for link in silent:
            link.close()


@pytest.mark.parametrize("request_of", [b"GET / HTTP/1.1\r\nHost: %s\r\n\r\n", b"PUT / HTTP/1.1\r\nHost: %s\r\n\r\n",
                                        b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"])  # fmt: skip
def test_a_client_without_access_is_disconnected(served, request_of):
    host = f"127.0.0.1:{served.port}".encode()
    with socket.create_connection(("127.0.0.1", served.port), 10) as link:
        link.sendall(request_of.replace(b"%s", host))
        data = b""
        while part := link.recv(4096):
            data += part
    assert data.startswith(b"HTTP/1.1 4") and b"connection: close" in data.lower()


def test_messages_that_nobody_reads_are_bounded():
    """A window that does not read is closed, and its messages are dropped."""
    tracemalloc.start()
    try:
        for text, most in (("x" * 100_000, window.ROOM + (8 << 20)), ("x", 8 << 20)):
            client = Window()
            before = tracemalloc.get_traced_memory()[0]
            for number in range(60_000):
                client.put(text + str(number))
            assert client.overrun.is_set() and not client._waiting
            assert tracemalloc.get_traced_memory()[1] - before < most
            tracemalloc.reset_peak()
        # A single message above this limit is sent.
        client = Window()
        client.put("x" * (window.ROOM + 1))
        assert not client.overrun.is_set()
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    "fields", [{"kind": "hello", "protocol": 1}, {"kind": "describe", "key": {"run": 0}}]
)
def test_a_script_that_never_reads_takes_bounded_memory_and_ends(served, fields):
    place = Path(f"/proc/{served.process.pid}/status")
    if not place.is_file():
        pytest.skip("no list of processes")
    before = memory(place)
    from websockets.exceptions import ConnectionClosed
    from websockets.sync.client import connect as dial

    url, headers = served.url.replace("http", "ws") + "/socket", {"Authorization": f"Bearer {served.key}"}
    with dial(url, additional_headers=headers, proxy=None, max_queue=(2, 1), ping_interval=None) as link:
        link.send(json.dumps({"kind": "hello", "protocol": 1}))
        with pytest.raises((ConnectionClosed, OSError, TimeoutError)):
            link.socket.settimeout(10)
            for number in range(60_000):
                link.send(json.dumps({**fields, "id": number}))
            # Messages from before the end can still be read.
            while True:
                link.recv(10)
    assert memory(place) - before < 160 << 20
    assert fetch(served, "/").startswith(b"<!doctype html>")


def memory(place: Path) -> int:
    """Read the largest memory of a process so far, bytes."""
    row = next(line for line in place.read_text().splitlines() if line.startswith("VmHWM"))
    return int(row.split()[1]) << 10


def test_more_commands_than_can_wait_are_refused(tmp_path):
    async def work() -> None:
        session, client = Session(tmp_path, []), Window()
        session.ready.set()
        for number in range(4_100):
            await obey(session, client, m.Propose(id=number))
            if number % 100 == 0:
                # Empty the queue, as a window that reads does.
                answers = events(client)
                client._waiting.clear()
                assert all(event["kind"] == "error" for event in answers)
        assert len(session._tasks) <= 4_000
        assert events(client)[-1]["problem"]["code"] == "busy"
        await session.end()

    asyncio.run(work())


async def upload(guard: Any, send: Any) -> None:
    """Send a request with a mesh of one byte."""
    scope = {
        "type": "http", "http_version": "1.1", "method": "POST", "path": "/upload", "raw_path": b"/upload",
        "query_string": b"name=a.stl",
        "headers": [(b"host", b"127.0.0.1:1234"), (b"authorization", f"Bearer {guard.key}".encode())],
    }  # fmt: skip

    async def receive() -> dict:
        return {"type": "http.request", "body": b"x", "more_body": False}

    await guard(scope, receive, send)


def test_uploads_are_read_by_a_few_processes_at_a_time(tmp_path, monkeypatch):
    """Twelve uploads at once each get an answer, and no more than the limit are read at a time."""
    most = [0, 0]

    async def read(*_: Any) -> Any:
        most[0] += 1
        most[1] = max(most)
        await asyncio.sleep(0.05)
        most[0] -= 1
        return server.JSONResponse({})

    monkeypatch.setattr(server, "_read", read)
    answered: list[int] = []

    async def work() -> None:
        session = Session(tmp_path, [])
        guard = server.application(session, 1234)

        async def send_upload() -> None:
            async def send(message: dict) -> None:
                if message["type"] == "http.response.start":
                    answered.append(message["status"])

            await upload(guard, send)

        async with asyncio.timeout(30):
            await asyncio.gather(*(send_upload() for _ in range(12)))
        await session.end()

    asyncio.run(work())
    assert answered == [200] * 12 and most == [0, server.READERS]


def test_an_upload_on_a_full_disk_gives_a_message(tmp_path, monkeypatch):
    def full(*_: Any, **__: Any) -> Any:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(server.tempfile, "TemporaryDirectory", full)
    messages: list[dict] = []

    async def work() -> None:
        session = Session(tmp_path, [])
        guard = server.application(session, 1234)

        async def send(message: dict) -> None:
            messages.append(message)

        await upload(guard, send)
        await session.end()

    asyncio.run(work())
    assert messages[0]["status"] == 507 and "No space left" in json.loads(messages[1]["body"])["text"]
