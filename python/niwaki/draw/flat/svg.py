"""Marks as SVG: a group for each part; its title is the address, and its id is made from the address.

A unit of the page is a scene unit; see `niwaki.draw.page` for scenes far from the origin.
"""

from __future__ import annotations

import re
from itertools import groupby
from xml.sax.saxutils import escape, quoteattr

from niwaki.draw.assembly import Assembly
from niwaki.draw.finite import finite
from niwaki.draw.flat.drawing import Window
from niwaki.draw.flat.marks import Mark, Rgb, marks, style_of
from niwaki.draw.page import Page
from niwaki.errors import FileError


def svg(scene: Assembly, *, style: str = "ink", window: Window | None = None, margin: float = 0.04) -> str:
    """Write a scene of flat shapes as SVG.

    A part is a group; its edge, its light and its glow are further groups on their own layers. Soft marks are blurred
    by a filter and add light.

    Parameters
    ----------
    scene, style, window, margin
        As for `niwaki.draw.flat.drawing.drawing`.
    """
    if len(scene) == 0:
        raise FileError("scene-empty", verb="write")
    chosen = style_of(style)
    mark_list = marks(scene, chosen)
    for mark in mark_list:
        finite(mark.corners, mark.address)
    if window is None:
        (low_x, low_y, _), (high_x, high_y, _) = scene.bounds.tolist()
        wide, tall = high_x - low_x, high_y - low_y
        pad = margin * max(wide, tall)
        window = ((low_x - pad, low_y - pad), (high_x + pad, high_y + pad))
    (left, low), (right, high) = finite(window, "the page", "its corners").tolist()
    page = Page((left, low), (right, high))
    lines = [f"<svg {page.attributes}>"]
    used = {"paper"}
    for blur in sorted({mark.blur for mark in mark_list} - {0.0}):
        used.add(_filter(blur))
        lines.append(
            f'  <filter id="{_filter(blur)}" x="-100%" y="-100%" width="300%" height="300%">'
            f'<feGaussianBlur stdDeviation="{blur:g}"/></filter>'
        )
    x, y = map(page.number, page.at((left, high)))
    size = f'width="{page.number(page.width)}" height="{page.number(page.height)}"'
    lines.append(f'  <rect id="paper" x="{x}" y="{y}" {size} fill="{_hex(chosen.paper)}"/>')
    for (address, role), group in groupby(mark_list, key=lambda mark: (mark.address, mark.role)):
        name = identifier(address) + (f".{role}" if role else "")
        name = _free(name, used)
        lines.append(f"  <g id={quoteattr(name)}><title>{escape(address)}</title>")
        lines += [f"    {_path(mark, page)}" for mark in group]
        lines.append("  </g>")
    return "\n".join([*lines, "</svg>", ""])


def identifier(address: str) -> str:
    """Make an XML name that is close to the address: `branch/branch/emit#1` becomes `branch-x2.emit-1`."""
    steps = [(step, len(list(group))) for step, group in groupby(address.split("/"))]
    text = ".".join(step if count == 1 else f"{step}-x{count}" for step, count in steps)
    name = re.sub(r"[^A-Za-z0-9_.\-]+", "-", text.replace("]", "")).strip("-")
    return name if name[:1].isalpha() or name[:1] == "_" else f"part.{name}"


def _free(name: str, used: set[str]) -> str:
    """Return the name, with a number if it is in use; the result is then in use, too."""
    candidates = (name, *(f"{name}.{k}" for k in range(2, len(used) + 3)))
    free = next(candidate for candidate in candidates if candidate not in used)
    used.add(free)
    return free


def _path(mark: Mark, page: Page) -> str:
    first, _, corners = page.corners(list(mark.corners)).partition(" ")
    soft = f' filter="url(#{_filter(mark.blur)})" style="mix-blend-mode:screen"' if mark.blur else ""
    thin = f' opacity="{mark.opacity:g}"' if mark.opacity < 1.0 else ""
    return f'<path d="M{first} L{corners} Z" fill="{_hex(mark.fill)}"{thin}{soft}/>'


def _filter(blur: float) -> str:
    return f"soft-{blur:g}".replace(".", "-")


def _hex(color: Rgb) -> str:
    return "#" + "".join(f"{round(255.0 * min(max(part, 0.0), 1.0)):02x}" for part in color)
