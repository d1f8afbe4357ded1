"""Views of scenes: a page with the meshes and the studio's stage, which loads nothing from elsewhere.

In a notebook the page is the content of a frame: it needs no server and no extension, and a notebook that is saved as
HTML still shows it. Each page contains the stage, the script of 0.6 MB that the studio's page imports.
"""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Iterable
from functools import cache
from html import escape
from importlib.resources import files
from os import PathLike
from pathlib import Path
from typing import Any

import msgspec

from niwaki.draw.flat.marks import is_flat
from niwaki.draw.scene import Scene
from niwaki.errors.extras import optional
from niwaki.errors.files import write_whole
from niwaki.errors.settings import bad
from niwaki.methods import at_least_one
from niwaki.result import Result, Sample
from niwaki.studio.frames import frame
from niwaki.studio.worker import shapes
from niwaki.targets.target import Target

#: Height in pixels of the frame in a notebook: the stage and its line of buttons.
HEIGHT = 470

#: The policy by which a browser loads nothing, whatever the page contains.
POLICY = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:"


def view(
    shown: Result | Sample | Scene | Iterable[Sample | Scene],
    *,
    target: Target | bool = True,
    most: int = 12,
) -> View:
    """Show results that you can turn with the mouse or a finger; a click shows the name of a part.

    Parameters
    ----------
    shown
        A result (its samples, best first), a sample, a scene, or several samples and scenes.
    target
        The target, drawn as a ghost: True for the target of the first sample, a target, or False for none.
    most
        The most results of the view. A ship of 20 parts takes 0.2 MB.

    Returns
    -------
    View
        A view that a notebook shows; `save("ship.html")` writes it as a page.

    Raises
    ------
    InputError
        There are no results.
    """
    at_least_one("most", most)
    listed: list[Sample | Scene]
    if isinstance(shown, Result):
        ranked = sorted(shown.samples, key=lambda sample: -sample.log_score)
        listed = [*ranked] if ranked else [shown.best]
    else:
        listed = [shown] if isinstance(shown, Sample | Scene) else list(shown)
    if not listed:
        raise bad("shown", shown, "at least one sample or scene", "the result of a search")
    chosen = [_frame(entry) for entry in listed[:most]]
    if target is True:
        target = getattr(listed[0], "target", None) or False
    return View([*([_ghost(target)] if isinstance(target, Target) else []), *chosen])


class View:
    """A view of scenes that you can turn.

    Attributes
    ----------
    frames : list of bytes
        Meshes with their headers, as `niwaki.studio.frames` describes them.
    """

    def __init__(self, frames: list[bytes]) -> None:
        self.frames = frames

    def html(self) -> str:
        """Return the complete page."""
        data = json.dumps([base64.b64encode(zlib.compress(frame)).decode() for frame in self.frames])
        return (
            '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Niwaki</title>'
            f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
            "<style>body{margin:0}</style></head><body><div></div>"
            f'<script type="application/json" id="niwaki-frames">{data}</script>'
            f'<script type="module">{stage()}</script></body></html>'
        )

    def save(self, path: str | PathLike[str]) -> Path:
        """Write the page into a file that any browser opens without other files."""
        return write_whole(Path(path), self.html().encode())

    def widget(self) -> Any:
        """Return the view as an anywidget whose `frames` you can replace.

        Raises
        ------
        FileError
            anywidget is missing (extra `notebook`).
        """
        anywidget = optional("anywidget", "a widget", "notebook")
        traitlets = optional("traitlets", "a widget", "notebook")
        frames = traitlets.List(traitlets.Bytes()).tag(sync=True)
        viewer = type("Viewer", (anywidget.AnyWidget,), {"_esm": stage(), "frames": frames})
        return viewer(frames=self.frames)

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{escape(self.html())}" sandbox="allow-scripts" title="Niwaki" '
            f'style="width:100%;height:{HEIGHT}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<View: {len(self.frames)} meshes, {sum(map(len, self.frames)) / 1e6:.2f} MB>"


@cache
def stage() -> str:
    """Return the script of the stage, with its end tags escaped."""
    script = files("niwaki.studio").joinpath("page", "view.js").read_text(encoding="utf-8")
    return script.replace("</script", "<\\/script")


def _frame(result: Sample | Scene) -> bytes:
    if isinstance(result, Sample):
        fit = f"log score {result.log_score:.2f}" if result.fit is None else str(result.fit)
        scene, note = result.scene, f"{fit}, {result.primitives} primitives"
    else:
        scene, note = result, f"{len(result)} parts"
    header, payload = shapes.shape(scene, "fine", role="result", is_flat=is_flat(scene), note=note)
    return frame(msgspec.json.encode(header), payload)


def _ghost(target: Target) -> bytes:
    bounds = target.bounds
    (x, y, z), (u, v, w) = bounds.tolist()
    pivot = ((x + u) / 2, (y + v) / 2, (z + w) / 2)
    header, payload = shapes.ghost(target.vertices, target.faces, bounds, pivot, role="ghost")
    return frame(msgspec.json.encode(header), payload)
