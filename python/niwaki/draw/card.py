"""Cards for notebooks: a picture and its numbers as a piece of HTML without external resources."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from html import escape
from typing import Any

#: Settings of a picture that takes about a tenth of a second.
QUICK: dict[str, Any] = {"size": (480, 360), "samples": 4}

LEFT = 'style="text-align:left"'
STYLE = "display:flex;gap:1.5em;flex-wrap:wrap;align-items:center"


def card(title: str, rows: Mapping[str, object], png: bytes | None = None) -> str:
    """Write a title, a table of two columns and a picture as HTML.

    Parameters
    ----------
    title
        The line above the table.
    rows
        Values by name; None is left out.
    png
        The picture as the bytes of a PNG file.
    """
    image = ""
    if png is not None:
        data = base64.b64encode(png).decode()
        image = f'<img alt="{escape(title)}" src="data:image/png;base64,{data}" style="max-width:100%">'
    cells = "".join(
        f"<tr><th {LEFT}>{escape(name)}</th><td {LEFT}>{escape(_text(value))}</td></tr>"
        for name, value in rows.items()
        if value is not None
    )
    return f'<div style="{STYLE}">{image}<div><b>{escape(title)}</b><table>{cells}</table></div></div>'


def _text(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
