"""The server of the Model Context Protocol: on standard input and output, or at `/mcp` of the studio's server.

Over HTTP the studio's guard stands in front (`niwaki.studio.security`): loopback only, the session's key or cookie,
`Host` and `Origin` of the studio. A person can watch the same session in the studio's page.
"""

from __future__ import annotations

import asyncio
import base64
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import mcp_types as types
from mcp.server import Server
from mcp.server.stdio import stdio_server
from mcp.server.streamable_http_manager import StreamableHTTPASGIApp, StreamableHTTPSessionManager
from starlette.routing import Route

from niwaki import _engine
from niwaki.agents import tools
from niwaki.agents.caller import Caller
from niwaki.errors.folders import held_folder
from niwaki.studio import serving
from niwaki.studio.session import Session, begin

#: What a client tells its language model about these tools.
INSTRUCTIONS = """\
Niwaki grows procedural models into shapes. A model is a Python function with random choices: you write the model, and
Niwaki searches the choices. Steps: `write` a model below the folder, mend what the answer names, `model`, `preview`,
`ask` for a target, `run`, `show` a result, `hold` or `reroll` parts, `run` again, `export`. An answer has at most 4 kB.
A call that takes longer than a second answers that it is at work; `answer` asks for its end. A file
`requirements.toml` beside a model belongs to a person: results have to keep it, and no tool changes it."""


def server(caller: Caller) -> Server[Any]:
    """Make the server of a caller."""

    async def list_tools(context: Any, params: Any) -> types.ListToolsResult:
        return types.ListToolsResult(
            tools=[
                types.Tool(name=tool.name, description=tool.description, input_schema=tool.schema)
                for tool in tools.tools()
            ]
        )

    async def call_tool(context: Any, params: types.CallToolRequestParams) -> types.CallToolResult:
        reply = await caller.call(params.name, params.arguments or {})
        content: list[types.ContentBlock] = [types.TextContent(text=reply.text)]
        if reply.picture is not None:
            data = base64.b64encode(reply.picture).decode()
            content.append(types.ImageContent(data=data, mime_type="image/png"))
        return types.CallToolResult(content=content, is_error=reply.has_failed)

    return Server(
        "niwaki",
        version=_engine.__version__,
        instructions=INSTRUCTIONS,
        on_list_tools=list_tools,
        on_call_tool=call_tool,
    )


@asynccontextmanager
async def calling(root: Path, folder: Path) -> AsyncIterator[Caller]:
    """Open a session and a caller of it.

    Parameters
    ----------
    root
        The folder below which calls may name, read and write files.
    folder
        The folder of the session; a session that is there resumes.
    """
    session = Session(folder, [], root=root)
    beginning = asyncio.create_task(begin(session, glimpses=False))
    caller = Caller(session)
    try:
        yield caller
    finally:
        caller.end()
        beginning.cancel()
        await session.end()


def serve(root: Path, folder: Path) -> None:
    """Serve on standard input and output, until the input ends.

    Raises
    ------
    FileError
        `folder-in-use`: another studio uses this session.
    """
    with held_folder(folder):
        asyncio.run(_serve(root, folder))


async def _serve(root: Path, folder: Path) -> None:
    async with calling(root, folder) as caller, stdio_server() as (source, sink):
        served = server(caller)
        await served.run(source, sink, served.create_initialization_options())


def serve_http(root: Path, folder: Path, port: int, browser: bool) -> None:
    """Serve on loopback HTTP beside the studio's page, until Ctrl-C.

    Raises
    ------
    FileError
        `folder-in-use`: another studio uses this session.
    """
    serving.serve([], folder, port, browser, root=root, beside=_routes)


@asynccontextmanager
async def _routes(session: Session) -> AsyncIterator[Sequence[Route]]:
    caller = Caller(session)
    manager = StreamableHTTPSessionManager(server(caller), max_sessions=32)
    async with manager.run():
        try:
            yield [Route("/mcp", endpoint=StreamableHTTPASGIApp(manager))]
        finally:
            caller.end()
