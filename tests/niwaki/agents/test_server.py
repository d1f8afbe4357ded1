"""The server as a client meets it: on standard input and output, and over HTTP behind the studio's guard."""

from __future__ import annotations

import asyncio
import json
import os
import subprocess
import sys
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("mcp")

import httpx2
from mcp import ClientSession, StdioServerParameters
from mcp.client.stdio import stdio_client
from mcp.client.streamable_http import streamable_http_client
from niwaki.agents import tools

COMMAND = ["-m", "niwaki.shell.main", "mcp"]


async def named(client: ClientSession) -> list[str]:
    """Begin, and return the names of the tools; look at a field of the state."""
    handshake = await client.initialize()
    assert "requirements.toml" in (handshake.instructions or "")
    looked = await client.call_tool("look", {"fields": ["settings"]})
    while " is at work" in looked.content[0].text:
        looked = await client.call_tool("answer", {"id": 1})
    assert '"count":8' in looked.content[0].text and not looked.is_error
    refused = await client.call_tool("look", {"fields": ["secrets"]})
    assert refused.is_error and "no-field" in refused.content[0].text
    return [tool.name for tool in (await client.list_tools()).tools]


def test_a_client_on_standard_input_and_output(tmp_path: Path):
    async def session() -> list[str]:
        place = StdioServerParameters(
            command=sys.executable, args=[*COMMAND, str(tmp_path)], env=dict(os.environ)
        )
        async with stdio_client(place) as (source, sink), ClientSession(source, sink) as client:
            return await named(client)

    assert asyncio.run(session()) == [tool.name for tool in tools.tools()]


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str]]:
    """The URL and the key of a server on loopback."""
    folder = tmp_path_factory.mktemp("models")
    command = [sys.executable, *COMMAND, str(folder), "--http"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert "the studio is at" in process.stdout.readline()
        url, key = (folder / "studio-session" / "key").read_text().split()
        yield f"{url}/mcp", key
        process.terminate()


def test_a_client_over_http_with_the_key(address: tuple[str, str]):
    url, key = address

    async def session() -> list[str]:
        async with (
            httpx2.AsyncClient(headers={"Authorization": f"Bearer {key}"}, timeout=60) as web,
            streamable_http_client(url, http_client=web) as (source, sink, *_),
            ClientSession(source, sink) as client,
        ):
            return await named(client)

    assert asyncio.run(session()) == [tool.name for tool in tools.tools()]


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 403),
        ({"Authorization": "Bearer wrong"}, 403),
        ({"Authorization": "KEY", "Origin": "http://example.com"}, 403),
        ({"Authorization": "KEY", "Origin": "null"}, 403),
        ({"Authorization": "KEY", "Host": "example.com"}, 421),
        ({"Authorization": "KEY", "Sec-Fetch-Site": "cross-site"}, 403),
        ({"Authorization": "KEY"}, 200),
    ],
)
def test_http_needs_the_key_the_host_and_the_origin(address, headers: dict[str, str], status: int):
    url, key = address
    named = {name: value.replace("KEY", f"Bearer {key}") for name, value in headers.items()}
    version = {
        "protocolVersion": "2025-06-18",
        "capabilities": {},
        "clientInfo": {"name": "t", "version": "1"},
    }
    body = {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": version}
    kinds = {"Content-Type": "application/json", "Accept": "application/json, text/event-stream"}
    request = urllib.request.Request(url, json.dumps(body).encode(), {**kinds, **named})
    try:
        with urllib.request.urlopen(request, timeout=20) as answer:
            code = answer.status
    except urllib.error.HTTPError as error:
        code = error.code
    assert code == status
