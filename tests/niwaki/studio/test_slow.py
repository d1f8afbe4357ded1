"""Limits of time and memory for uploads."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys

import pytest

pytest.importorskip("starlette")

import trimesh
from niwaki.studio import server
from niwaki.studio.session import Session


def test_a_body_that_comes_slowly_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(server, "PATIENCE", 0.2)
    messages: list[dict] = []

    async def work() -> None:
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
            # Single bytes without an end.
            await asyncio.sleep(0.02)
            return {"type": "http.request", "body": b"x", "more_body": True}

        async def send(message: dict) -> None:
            messages.append(message)

        async with asyncio.timeout(5):
            await guard(scope, receive, send)
        await session.end()

    asyncio.run(work())
    assert messages[0]["status"] == 408
    assert json.loads(messages[1]["body"])["code"] == "too-slow"


def test_a_mesh_that_takes_more_memory_than_its_process_may_have_is_refused(tmp_path):
    place = tmp_path / "ball.stl"
    place.write_bytes(trimesh.creation.icosphere(7).export(file_type="stl"))
    # The limit is a little above the memory before reading: 320 thousand triangles do not fit.
    program = """
import sys
from pathlib import Path
from niwaki.studio.worker import uploads
pages = int(Path("/proc/self/statm").read_text().split()[0])
uploads.MEMORY = 4096 * pages + (24 << 20)
uploads.main(*sys.argv[1:])
"""
    command = [sys.executable, "-c", program, str(place), str(tmp_path / "out.stl")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode != 0 or json.loads(done.stdout.splitlines()[-1])["code"] == "mesh-too-large"
    assert not (tmp_path / "out.stl").exists()
