"""`niwaki studio`: a page for models in the browser of this machine."""

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
        typer.Argument(metavar="[MODEL.PY]...", help="Files of models, in addition to the gallery."),
    ] = None,
    session: Annotated[
        Path,
        typer.Option(
            "--session", metavar="FOLDER", help="Folder of the session. An existing session is resumed."
        ),
    ] = Path("studio-session"),
    port: Annotated[
        int, typer.Option("--port", metavar="N", help="Port of the server; 0 takes a free port.")
    ] = 0,
    trust: Annotated[
        bool,
        typer.Option(
            "--trust",
            help="Run Python files that results name, if they are unchanged. Models with host functions need it.",
        ),
    ] = False,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser.")
    ] = True,
) -> None:
    """Open a page in the browser: search, hold parts that you like, grow the rest again."""
    # The studio imports the shell, so the command imports it by name.
    optional("niwaki.studio.serving", "the studio", "studio").serve(
        models or [], session, port, browser, trust
    )
