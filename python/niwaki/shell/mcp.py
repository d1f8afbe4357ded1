"""`niwaki mcp`: the studio's messages as tools for programs that write models."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from niwaki.errors import FileError
from niwaki.errors.extras import optional
from niwaki.shell.app import app


@app.command()
def mcp(
    folder: Annotated[
        Path,
        typer.Argument(metavar="MODELS", help="The folder of the models. Messages reach no file outside."),
    ] = Path("."),
    session: Annotated[
        Path | None,
        typer.Option(
            "--session",
            metavar="FOLDER",
            help="Folder of the session. An existing session is resumed. Default: studio-session in MODELS.",
        ),
    ] = None,
    http: Annotated[
        bool, typer.Option("--http", help="Serve loopback HTTP at /mcp, beside the studio's page.")
    ] = False,
    port: Annotated[
        int, typer.Option("--port", metavar="N", help="Port of the server; 0 takes a free port.")
    ] = 0,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = False,
) -> None:
    """Serve the messages of the studio to a program, by the Model Context Protocol."""
    if not folder.is_dir():
        raise FileError("file-missing", folder, absolute=folder.absolute(), folder=Path.cwd())
    # The server imports the shell, so the command imports it by name.
    server = optional("niwaki.agents.server", "the tools of a program", "mcp")
    place = session or folder / "studio-session"
    if http:
        server.serve_http(folder, place, port, browser)
    else:
        server.serve(folder, place)
