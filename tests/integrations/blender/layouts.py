"""A layout that records what a panel draws, because `bpy` has no window."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import bpy


class Layout(SimpleNamespace):
    """A layout without a window."""

    drawn: list[str] = []

    def __getattr__(self, name: str) -> Any:
        def note(*words: Any, **settings: Any) -> Any:
            if name == "prop":
                assert words[1] in words[0].bl_rna.properties
            self.drawn.append(" ".join([name, *map(str, words[-1:]), *map(str, settings.values())]))
            return Layout()

        return note


def drawn(panel: Any, methods: tuple[str, ...]) -> str:
    """Draw a panel that has these methods; return a line for each call of its layouts."""
    Layout.drawn.clear()
    fake = SimpleNamespace(layout=Layout())
    for name in methods:
        setattr(fake, name, getattr(panel, name).__get__(fake))
    panel.draw(fake, bpy.context)
    return "\n".join(Layout.drawn)
