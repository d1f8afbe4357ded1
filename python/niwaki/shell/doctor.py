"""`niwaki doctor`: versions, the machine, the optional packages, and small tests of the core."""

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
    """Report versions, the machine and optional packages, and test the core. Exit code 1: the core does not work."""
    report = checkup.doctor()
    print(json.dumps(report.data(), indent=2) if as_json else report)
    if not report.works:
        raise typer.Exit(1)
