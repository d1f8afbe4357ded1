"""`niwaki studio`: models in a page of this machine's browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from niwaki.errors.extras import optional
from niwaki.shell.app import app


@app.command()
def studio(
    models: Annotated[
        list[str] | None,
        typer.Argument(metavar="[MODEL.PY]...", help="Files of models; the gallery is there, too."),
    ] = None,
    session: Annotated[
        Path, typer.Option("--session", metavar="FOLDER", help="Where the session is stored, and goes on.")
    ] = Path("studio-session"),
    port: Annotated[int, typer.Option("--port", metavar="N", help="Default: a free one.")] = 0,
    trust: Annotated[
        bool,
        typer.Option(
            "--trust",
            help="Run the Python files that results name, where unchanged: for models with host functions.",
        ),
    ] = False,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page.")] = True,
) -> None:
    """Turn the knobs of models in a page: search, hold what you like, grow the rest again."""
    # The studio stands above the shell; only this command starts it.
    optional("niwaki.studio.serving", "the studio", "studio").serve(
        models or [], session, port, browser, trust
    )
