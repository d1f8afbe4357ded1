"""Plans: a scene from above, as an architect draws it, as SVG for a page or pixels for a screen.

Each shape is drawn as its convex outline, lower shapes first. The plan has x to the right and -z upwards: shapes nearer
to the viewer of the scene are lower on the page.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from PIL import Image, ImageDraw

from niwaki.draw.assembly import Assembly
from niwaki.draw.finite import finite
from niwaki.draw.page import Page
from niwaki.draw.palette import paints
from niwaki.draw.picture import png
from niwaki.errors import FileError
from niwaki.errors.files import write_whole
from niwaki.words.vectors import VecLike, _vec

Point = tuple[float, float]
Rgb = tuple[float, float, float]

PAPER: Rgb = (0.975, 0.97, 0.96)
FLOOR: Rgb = (0.93, 0.915, 0.885)
INK = 0.55


@dataclass(frozen=True)
class Patch:
    """A filled outline of the plan.

    Attributes
    ----------
    corners : list of (x, y)
        Scene units; x to the right, y upwards.
    fill
        sRGB in [0, 1].
    height
        The height of the highest point, scene units; higher patches lie on top.
    """

    corners: list[Point]
    fill: Rgb
    height: float


def patches(scene: Assembly, outline: Sequence[VecLike] = ()) -> list[Patch]:
    """List the patches of a plan, from the floor upwards.

    Parameters
    ----------
    scene
        The shapes on the floor.
    outline
        The floor, a polygon in the plan's coordinates; none when left out.
    """
    drawn: list[Patch] = []
    for part, part_paints in zip(scene.parts, paints(scene), strict=True):
        for shape, paint in zip(part.shapes, part_paints, strict=True):
            vertices = shape.vertices()
            points = [(float(x), -float(z)) for x, _, z in vertices]
            finite(vertices, part.address)
            drawn.append(Patch(_hull(points), paint.color, float(vertices[:, 1].max())))
    drawn.sort(key=lambda patch: patch.height)
    if outline:
        corners = [(_vec(corner).x, _vec(corner).y) for corner in outline]
        finite(corners, "the floor")
        drawn.insert(0, Patch(corners, FLOOR, 0.0))
    if not drawn:
        raise FileError("scene-empty", verb="draw")
    return drawn


def plan(
    scene: Assembly,
    outline: Sequence[VecLike] = (),
    *,
    width: int = 960,
    margin: float = 0.04,
    scale_bar: float | None = 1.0,
) -> Image.Image:
    """Draw a scene from above.

    Parameters
    ----------
    scene
        The shapes on the floor.
    outline
        The floor, a polygon in the plan's coordinates.
    width
        Of the picture in pixels; its height follows.
    margin
        Empty border as a share of the width.
    scale_bar
        Length of the scale bar in the corner, scene units; None for no bar.
    """
    if not isinstance(width, int) or not 16 <= width <= 16_384:
        raise FileError("setting", name="width", found=width, expected="a whole number from 16 to 16384")
    shown = patches(scene, outline)
    (left, low), (right, high) = _bounds(shown)
    pad = margin * (right - left) / (1.0 - 2.0 * margin)
    fine = 4 * width / (right - left + 2.0 * pad)
    size = (4 * width, max(4, round((high - low + 2.0 * pad) * fine / 4) * 4))
    page = Image.new("RGB", size, _bytes(PAPER))
    pen = ImageDraw.Draw(page)

    def at(point: Point) -> Point:
        return ((point[0] - left + pad) * fine, (high + pad - point[1]) * fine)

    line = max(2, round(0.0016 * size[0]))
    for patch in shown:
        corners = [at(corner) for corner in patch.corners]
        pen.polygon(corners, fill=_bytes(patch.fill))
        pen.line(
            [*corners, corners[0], corners[1]], fill=_bytes(_darker(patch.fill)), width=line, joint="curve"
        )
    if scale_bar is not None:
        end = at((right, low - 0.5 * pad))
        pen.line([(end[0] - scale_bar * fine, end[1]), end], fill=(90, 86, 80), width=3 * line)
    return page.resize((size[0] // 4, size[1] // 4), Image.Resampling.LANCZOS)


def plan_svg(scene: Assembly, outline: Sequence[VecLike] = (), *, margin: float = 0.04) -> str:
    """Write a scene from above as SVG; a unit of the page is a scene unit (see `niwaki.draw.page`).

    Parameters
    ----------
    scene, outline, margin
        As for `plan`.
    """
    shown = patches(scene, outline)
    (left, low), (right, high) = _bounds(shown)
    pad = margin * (right - left)
    page = Page((left - pad, low - pad), (right + pad, high + pad))
    line = page.number(0.0016 * page.width)
    lines = [f'<svg {page.attributes} stroke-width="{line}" stroke-linejoin="round">']
    for patch in shown:
        points = page.corners(patch.corners)
        lines.append(
            f'  <polygon points="{points}" fill="{_hex(patch.fill)}" stroke="{_hex(_darker(patch.fill))}"/>'
        )
    return "\n".join([*lines, "</svg>", ""])


def save(path: str | PathLike[str], scene: Assembly, outline: Sequence[VecLike] = ()) -> Path:
    """Write a plan into a file, SVG or PNG by its suffix.

    Parameters
    ----------
    path
        The file.
    scene, outline
        As for `plan`.
    """
    place = Path(path)
    if place.suffix.lower() == ".svg":
        return write_whole(place, plan_svg(scene, outline).encode())
    if place.suffix.lower() == ".png":
        return write_whole(place, png(plan(scene, outline)))
    shown = place.suffix or "no suffix"
    raise FileError("file-format", place, suffix=shown, done="drawn", formats=".svg, .png")


def _hull(points: Sequence[Point]) -> list[Point]:
    """Compute the convex hull, counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return [*ordered, *ordered[::-1]]

    def chain(line: Sequence[Point]) -> list[Point]:
        corners: list[Point] = []
        for p in line:
            while len(corners) > 1 and _turn(corners[-2], corners[-1], p) <= 0.0:
                corners.pop()
            corners.append(p)
        return corners[:-1]

    return chain(ordered) + chain(ordered[::-1])


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _bounds(shown: Sequence[Patch]) -> tuple[Point, Point]:
    xs = [x for patch in shown for x, _ in patch.corners]
    ys = [y for patch in shown for _, y in patch.corners]
    return (min(xs), min(ys)), (max(xs), max(ys))


def _darker(color: Rgb) -> Rgb:
    return (INK * color[0], INK * color[1], INK * color[2])


def _bytes(color: Rgb) -> tuple[int, int, int]:
    red, green, blue = (round(255.0 * min(max(part, 0.0), 1.0)) for part in color)
    return (red, green, blue)


def _hex(color: Rgb) -> str:
    return "#{:02x}{:02x}{:02x}".format(*_bytes(color))
