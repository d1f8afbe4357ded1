"""Marks as SVG: a group for each part, its id made of the address, its title the address itself.

One unit of the page is one of the scene; see `niwaki.draw.page` for scenes far from the origin.
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

    A part is a group, and its edge, its light and its glow, which lie on layers of their own, are further ones.
    Soft marks are blurred by a filter and added as light.

    Parameters
    ----------
    scene, style, window, margin
        As for `niwaki.draw.flat.drawing.drawing`.
    """
    if len(scene) == 0:
        raise FileError("scene-empty", verb="write")
    chosen = style_of(style)
    drawn = marks(scene, chosen)
    for mark in drawn:
        finite(mark.corners, mark.address)
    if window is None:
        (low_x, low_y, _), (high_x, high_y, _) = scene.bounds.tolist()
        wide, tall = high_x - low_x, high_y - low_y
        pad = margin * max(wide, tall)
        window = ((low_x - pad, low_y - pad), (high_x + pad, high_y + pad))
    (left, low), (right, high) = finite(window, "the page", "its corners").tolist()
    page = Page((left, low), (right, high))
    lines = [f"<svg {page.attributes}>"]
    taken = {"paper"}
    for blur in sorted({mark.blur for mark in drawn} - {0.0}):
        taken.add(_filter(blur))
        lines.append(
            f'  <filter id="{_filter(blur)}" x="-100%" y="-100%" width="300%" height="300%">'
            f'<feGaussianBlur stdDeviation="{blur:g}"/></filter>'
        )
    x, y = map(page.number, page.at((left, high)))
    size = f'width="{page.number(page.width)}" height="{page.number(page.height)}"'
    lines.append(f'  <rect id="paper" x="{x}" y="{y}" {size} fill="{_hex(chosen.paper)}"/>')
    for (address, role), group in groupby(drawn, key=lambda mark: (mark.address, mark.role)):
        name = identifier(address) + (f".{role}" if role else "")
        name = _free(name, taken)
        lines.append(f"  <g id={quoteattr(name)}><title>{escape(address)}</title>")
        lines += [f"    {_path(mark, page)}" for mark in group]
        lines.append("  </g>")
    return "\n".join([*lines, "</svg>", ""])


def identifier(address: str) -> str:
    """A name that XML allows, as near to the address as it can be: `branch/branch/emit#1` is `branch-x2.emit-1`."""
    steps = [(step, len(list(same))) for step, same in groupby(address.split("/"))]
    text = ".".join(step if count == 1 else f"{step}-x{count}" for step, count in steps)
    name = re.sub(r"[^A-Za-z0-9_.\-]+", "-", text.replace("]", "")).strip("-")
    return name if name[:1].isalpha() or name[:1] == "_" else f"part.{name}"


def _free(name: str, taken: set[str]) -> str:
    """The name, or with the first number that makes it another than those taken; it is taken then."""
    found = next(
        one for one in (name, *(f"{name}.{k}" for k in range(2, len(taken) + 3))) if one not in taken
    )
    taken.add(found)
    return found


def _path(mark: Mark, page: Page) -> str:
    first, _, corners = page.corners(list(mark.corners)).partition(" ")
    soft = f' filter="url(#{_filter(mark.blur)})" style="mix-blend-mode:screen"' if mark.blur else ""
    thin = f' opacity="{mark.opacity:g}"' if mark.opacity < 1.0 else ""
    return f'<path d="M{first} L{corners} Z" fill="{_hex(mark.fill)}"{thin}{soft}/>'


def _filter(blur: float) -> str:
    return f"soft-{blur:g}".replace(".", "-")


def _hex(color: Rgb) -> str:
    return "#" + "".join(f"{round(255.0 * min(max(part, 0.0), 1.0)):02x}" for part in color)
