"""Cutting sheets: the pieces of a structure as numbered outlines on boards, in millimetres, with the kerf added.

Each block must be an outline, and all must have the same thickness (`cut_pieces`). Each outline grows by half the kerf,
the width of the cut. Rectpack (MaxRects) packs the rectangles around the outlines, and turns them where that helps.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from niwaki.draw.finite import finite
from niwaki.errors import FileError
from niwaki.errors.extras import optional
from niwaki.errors.files import write_whole
from niwaki.stacks.structure import Floats, Structure

#: Corners of the two outlines that a block may have, and the edges along its thickness.
OUTLINES = (
    ((0, 1, 5, 4), ((0, 3), (1, 2), (5, 6), (4, 7))),
    ((0, 4, 7, 3), ((0, 1), (4, 5), (7, 6), (3, 2))),
)

#: Lengths are equal if they differ by at most this, in metres.
LENGTH_TOLERANCE = 1e-7

MILLIMETRES = 1000.0
#: Units of the packer in a millimetre: it counts in whole hundredths.
GRAIN = 100.0
INK, CUT = "#20304c", "#d62728"


@dataclass(frozen=True)
class Piece:
    """An outline on a board, millimetres from its lower left corner.

    Attributes
    ----------
    number : int
        The number of the piece, from 1 at the bottom of the structure.
    board : int
        The number of the board, from 0.
    outline : array of shape (4, 2)
        The outline of the piece.
    cut : array of shape (corners, 2)
        The middle of the cut, half a kerf outside of the outline.
    """

    number: int
    board: int
    outline: Floats
    cut: Floats


@dataclass(frozen=True)
class Sheet:
    """Boards with their pieces.

    Attributes
    ----------
    pieces : tuple of Piece
        The pieces, sorted by number.
    board : (float, float)
        Width and height of a board, millimetres.
    boards : int
        Number of boards.
    thickness : float
        Thickness of the board, millimetres.
    kerf, gap : float
        Width of the cut, and least distance between two cuts and from a cut to the board's edge, millimetres.
    """

    pieces: tuple[Piece, ...]
    board: tuple[float, float]
    boards: int
    thickness: float
    kerf: float
    gap: float

    def on(self, board: int) -> list[Piece]:
        """Return the pieces of a board."""
        return [piece for piece in self.pieces if piece.board == board]

    def svg(self, board: int = 0) -> str:
        """Return a board as SVG in millimetres: cuts in red, numbers in dark blue."""
        width, height = self.board
        body = [
            f'<rect width="{width:g}" height="{height:g}" fill="none" stroke="#b8b8b8" stroke-width="0.3"/>'
        ]
        for piece in self.on(board):
            path = " ".join(f"{x:.4f},{height - y:.4f}" for x, y in piece.cut)
            body.append(f'<polygon points="{path}" fill="none" stroke="{CUT}" stroke-width="0.1"/>')
            (x, y), size = label(piece.outline)
            body.append(
                f'<text x="{x:.3f}" y="{height - y + 0.35 * size:.3f}" font-size="{size:.2f}" fill="{INK}">'
                f"{piece.number}</text>"
            )
        return svg_page(width, height, body)

    def _repr_svg_(self) -> str:
        return self.svg()

    def dxf(self, board: int = 0) -> str:
        """Return a board as DXF in millimetres, with the layers CUT, NUMBERS and BOARD.

        Raises
        ------
        FileError
            ezdxf is missing (extra `stacks`).
        """
        ezdxf = need("ezdxf")
        document: Any = ezdxf.new("R2010", units=4)
        for name, color in (("CUT", 1), ("NUMBERS", 5), ("BOARD", 8)):
            document.layers.add(name, color=color)
        space = document.modelspace()
        width, height = self.board
        edge = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
        space.add_lwpolyline(edge, close=True, dxfattribs={"layer": "BOARD"})
        for piece in self.on(board):
            space.add_lwpolyline(piece.cut.tolist(), close=True, dxfattribs={"layer": "CUT"})
            place, size = label(piece.outline)
            text = space.add_text(str(piece.number), height=0.7 * size, dxfattribs={"layer": "NUMBERS"})
            text.set_placement(place, align=ezdxf.enums.TextEntityAlignment.MIDDLE_CENTER)
        out = io.StringIO()
        document.write(out)
        return out.getvalue()

    def save(self, path: str | PathLike[str]) -> list[Path]:
        """Write each board to a `.dxf` or `.svg` file; the second and further boards get a number.

        Raises
        ------
        FileError
            The format is unknown, or the file cannot be written.
        """
        place = Path(path)
        writers = {".dxf": self.dxf, ".svg": self.svg}
        if place.suffix.lower() not in writers:
            raise FileError(
                "file-format",
                place,
                suffix=place.suffix or "no suffix",
                done="cut",
                formats=", ".join(writers),
            )
        for piece in self.pieces:
            finite(piece.cut, f"piece {piece.number}", "its cut")
        names = [place] + [place.with_stem(f"{place.stem}-{board + 1}") for board in range(1, self.boards)]
        texts = [writers[place.suffix.lower()](board) for board in range(self.boards)]
        return [write_whole(name, text.encode()) for name, text in zip(names, texts, strict=True)]


def cut_sheet(
    structure: Structure,
    board: tuple[float, float] = (600.0, 400.0),
    kerf: float = 0.2,
    gap: float = 2.0,
) -> Sheet:
    """Lay out the pieces of a structure on boards.

    Parameters
    ----------
    structure
        A structure whose blocks are outlines of the same thickness.
    board
        Width and height of a board, millimetres.
    kerf
        Width of the cut, millimetres, 0 or more.
    gap
        Least distance between two cuts, and from a cut to the board's edge, millimetres, 0 or more.

    Raises
    ------
    FileError
        A block is not an outline, or larger than the board; rectpack or shapely is missing (extra `stacks`).
    """
    for name, number in (("kerf", kerf), ("gap", gap)):
        if not 0.0 <= number < np.inf:
            raise FileError("setting", name=name, found=number, expected="millimetres, 0 or more")
    if not all(0.0 < side < np.inf for side in board):
        raise FileError("setting", name="board", found=board, expected="two lengths above 0, millimetres")
    geometry, rectpack = need("shapely.geometry"), need("rectpack")
    outlines = [outline(corners, number) for number, corners in enumerate(structure.corners)]
    depth = outlines[0][1]
    for number, (_, other) in enumerate(outlines):
        if abs(other - depth) > LENGTH_TOLERANCE:
            raise FileError("piece-not-flat", block=f"block {number + 1}", depth=f"{depth * MILLIMETRES:g}")
    lying = [_level(geometry, points * MILLIMETRES, kerf) for points, _ in outlines]
    places = _packed(rectpack, [cut for _, cut in lying], board, gap)
    pieces = []
    for number, ((points, cut), (bin_, x, y, turned)) in enumerate(zip(lying, places, strict=True)):
        if turned:
            points, cut = _quarter(points), _quarter(cut)
        shift = np.array([x, y]) - cut.min(axis=0)
        pieces.append(Piece(number + 1, bin_, points + shift, cut + shift))
    boards = 1 + max(piece.board for piece in pieces)
    return Sheet(tuple(pieces), board, boards, depth * MILLIMETRES, kerf, gap)


def outline(corners: Floats, number: int) -> tuple[Floats, float]:
    """Return the outline of a block, of shape (4, 2), and its thickness, in metres."""
    depth = 0.0
    for face, edges in OUTLINES:
        along = np.array([corners[b] - corners[a] for a, b in edges])
        depth = float(np.linalg.norm(along[0]))
        points = corners[list(face)]
        flat = np.abs((points - points[0]) @ along[0]).max() <= LENGTH_TOLERANCE * depth
        if flat and np.abs(along - along[0]).max() <= LENGTH_TOLERANCE:
            out = along[0] / depth
            first = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
            second = np.cross(first, out)
            flat_points = np.stack([(points - points[0]) @ first, (points - points[0]) @ second], axis=1)
            return (flat_points if _area(flat_points) > 0.0 else flat_points[::-1].copy()), depth
    raise FileError("piece-not-flat", block=f"block {number + 1}", depth=f"{depth * MILLIMETRES:.3g}")


def _area(points: Floats) -> float:
    x, y = points.T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def _level(geometry: Any, points: Floats, kerf: float) -> tuple[Floats, Floats]:
    """Return outline and cut, turned so that the smallest rectangle around the cut is level."""
    grown = geometry.Polygon(points).buffer(0.5 * kerf, join_style="mitre", mitre_limit=4.0)
    cut = np.array(grown.exterior.coords)[:-1]
    box = np.array(grown.minimum_rotated_rectangle.exterior.coords)
    side = box[1] - box[0]
    side = side / np.linalg.norm(side)
    turn = np.array([[side[0], -side[1]], [side[1], side[0]]])
    return points @ turn, cut @ turn


def _quarter(points: Floats) -> Floats:
    return np.stack([-points[:, 1], points[:, 0]], axis=1)


def _packed(
    rectpack: Any, cuts: list[Floats], board: tuple[float, float], gap: float
) -> list[tuple[int, float, float, bool]]:
    """Return for each cut its board, the lower left corner of its rectangle, and whether it is turned."""
    # A rectangle contains its gap on the right and above; the board contains the gap on the left and below.
    sizes = [np.ceil((np.ptp(cut, axis=0) + gap) * GRAIN).astype(int) for cut in cuts]
    wide, high = (int((side - gap) * GRAIN) for side in board)
    for number, (w, h) in enumerate(sizes):
        if min(w, h) > min(wide, high) or max(w, h) > max(wide, high):
            needed = " x ".join(f"{side / GRAIN + gap:.1f}" for side in (w, h))
            size = " x ".join(f"{side:g}" for side in board)
            raise FileError("board-too-small", block=f"block {number + 1}", needed=needed, board=size)
    packer = rectpack.newPacker(rotation=True)
    for number, (w, h) in enumerate(sizes):
        packer.add_rect(int(w), int(h), rid=number)
    packer.add_bin(wide, high, count=float("inf"))
    packer.pack()
    places: dict[int, tuple[int, float, float, bool]] = {}
    for bin_, x, y, w, _, number in packer.rect_list():
        places[number] = (bin_, x / GRAIN + gap, y / GRAIN + gap, bool(w != sizes[number][0]))
    return [places[number] for number in range(len(cuts))]


@dataclass(frozen=True)
class Assembly:
    """A drawing of a structure from two sides.

    Attributes
    ----------
    page : str
        The SVG, in millimetres.
    """

    page: str

    def svg(self) -> str:
        """Return the drawing as SVG in millimetres."""
        return self.page

    def _repr_svg_(self) -> str:
        return self.svg()

    def save(self, path: str | PathLike[str]) -> list[Path]:
        """Write the drawing to an `.svg` file.

        Raises
        ------
        FileError
            The format is unknown, or the file cannot be written.
        """
        place = Path(path)
        if place.suffix.lower() != ".svg":
            shown = place.suffix or "no suffix"
            raise FileError("file-format", place, suffix=shown, done="drawn", formats=".svg")
        return [write_whole(place, self.page.encode())]


def assembly(structure: Structure) -> Assembly:
    """Draw a structure from the front and from the right; pieces have the numbers of the boards.

    A piece has no number in a view in which a nearer piece hides its middle.
    """
    views = (("front", 0, 1.0, 1), ("right", 1, 1.0, 0))
    corners = structure.corners * MILLIMETRES
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    edge = 20.0
    height = high[2] - low[2] + 3.0 * edge
    body, left = [], edge
    geometry = need("shapely.geometry")
    for name, across, sign, away in views:
        # Nearer pieces are drawn later: from the front those with smaller y, from the right with larger x.
        order = np.argsort(
            corners[:, :, away].mean(axis=1) * (-1.0 if name == "front" else 1.0), kind="stable"
        )
        shadows = {}
        for number in order:
            flat = np.stack(
                [sign * (corners[number, :, across] - low[across]), corners[number, :, 2] - low[2]], axis=1
            )
            hull = geometry.MultiPoint(flat).convex_hull
            shadows[number] = hull
            path = " ".join(f"{left + x:.3f},{height - edge - y:.3f}" for x, y in hull.exterior.coords[:-1])
            body.append(f'<polygon points="{path}" fill="#f4ead9" stroke="{INK}" stroke-width="0.4"/>')
        for place, number in enumerate(order):
            middle = shadows[number].centroid
            if any(shadows[nearer].contains(middle) for nearer in order[place + 1 :]):
                continue
            (x, y), size = label(np.array(shadows[number].exterior.coords)[:-1])
            body.append(
                f'<text x="{left + x:.3f}" y="{height - edge - y + 0.35 * size:.3f}" '
                f'font-size="{size:.2f}" fill="{INK}">{number + 1}</text>'
            )
        wide = high[across] - low[across]
        floor = height - edge
        body.append(
            f'<line x1="{left - 8:.3f}" x2="{left + wide + 8:.3f}" y1="{floor:.3f}" y2="{floor:.3f}" '
            f'stroke="{INK}" stroke-width="0.6"/>'
        )
        body.append(
            f'<text x="{left + 0.5 * wide:.3f}" y="{floor + 0.6 * edge:.3f}" font-size="6" fill="{INK}">'
            f"{escape(name)}</text>"
        )
        left += wide + 2.0 * edge
    return Assembly(svg_page(left - edge, height, body))


def label(points: Floats) -> tuple[tuple[float, float], float]:
    """Return the place and the size of a number in a convex outline."""
    x, y = points.T
    parts = x * np.roll(y, -1) - y * np.roll(x, -1)
    area = 0.5 * parts.sum()
    centre = np.array([((x + np.roll(x, -1)) * parts).sum(), ((y + np.roll(y, -1)) * parts).sum()]) / (
        6.0 * area
    )
    edges = np.roll(points, -1, axis=0) - points
    away = points - centre
    inner = np.abs(edges[:, 0] * away[:, 1] - edges[:, 1] * away[:, 0]) / np.linalg.norm(edges, axis=1)
    return (float(centre[0]), float(centre[1])), float(min(0.9 * inner.min(), 10.0))


def svg_page(width: float, height: float, body: list[str]) -> str:
    """Return an SVG page in millimetres."""
    lines = "\n".join(body)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}mm" height="{height:g}mm" '
        f'viewBox="0 0 {width:g} {height:g}" font-family="sans-serif" text-anchor="middle">\n{lines}\n</svg>\n'
    )


def need(module: str) -> Any:
    """Import a library of the extra `stacks`, or raise an error that names the extra."""
    return optional(module, "laying pieces out on a board", "stacks")
