"""`niwaki doctor`: what is installed, what works, and what is missing for what."""

from __future__ import annotations

import json
from typing import Annotated

import typer

from niwaki import checkup
from niwaki.shell.app import app


@app.command()
def doctor(
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Report versions, the machine and the extras, and try the core; exit 1 when the core does not work."""
    found = checkup.doctor()
    print(json.dumps(found.data(), indent=2) if as_json else found)
    if not found.works:
        raise typer.Exit(1)
