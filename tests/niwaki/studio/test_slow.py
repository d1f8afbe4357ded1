"""What comes slowly ends, and does not wait for ever."""

from __future__ import annotations

import asyncio
import json

import pytest

pytest.importorskip("starlette")

from niwaki.studio import server
from niwaki.studio.session import Session


def test_a_body_that_comes_slowly_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(server, "PATIENCE", 0.2)
    said: list[dict] = []

    async def asked() -> None:
        session = Session(tmp_path, [])
        guard = server.application(session, 1234)
        headers = {"host": "127.0.0.1:1234", "authorization": f"Bearer {guard.key}"}
        scope = {
            "type": "http",
            "http_version": "1.1",
            "method": "POST",
            "path": "/upload",
            "raw_path": b"/upload",
            "query_string": b"name=a.stl",
            "headers": [(name.encode(), value.encode()) for name, value in headers.items()],
        }

        async def receive() -> dict:
            # A byte at a time, for ever.
            await asyncio.sleep(0.02)
            return {"type": "http.request", "body": b"x", "more_body": True}

        async def send(message: dict) -> None:
            said.append(message)

        async with asyncio.timeout(5):
            await guard(scope, receive, send)
        await session.end()

    asyncio.run(asked())
    assert said[0]["status"] == 408
    assert json.loads(said[1]["body"])["code"] == "too-slow"
