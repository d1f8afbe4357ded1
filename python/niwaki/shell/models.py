"""`niwaki models`: the gallery, a line each."""

from __future__ import annotations

from niwaki.gallery import entries
from niwaki.shell.app import app


@app.command()
def models() -> None:
    """List the gallery: name, target, title."""
    for entry in entries():
        print(f"{entry.name:<16} {entry.target_name or entry.drawing_name or '-':<16} {entry.title}")
