"""Strokes as smooth curves that taper.

A stroke continues another stroke if it starts at the end of that stroke. Each stroke becomes a cubic Bezier curve
between its ends. The tangent at a joint is the mean of the two strokes; a third of it is the distance of the control
point. At a fork the curve continues into the last of the strokes, and the others branch off. Widths change evenly along
a stroke.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, cos, hypot, pi, sin

Point = tuple[float, float]

#: The number of straight pieces of a curve.
PIECES = 20
#: The number of straight pieces of a round end.
ROUND = 10


@dataclass(frozen=True)
class Stroke:
    """A stroke of a scene.

    Attributes
    ----------
    address : str
        The address of the part.
    start, end : (x, y)
        The ends, scene units.
    width, end_width : float
        The widths at both ends, scene units.
    z : float
        The height above the plane; higher strokes lie in front.
    """

    address: str
    start: Point
    end: Point
    width: float
    end_width: float
    z: float = 0.0

    @property
    def along(self) -> Point:
        """Vector from the start to the end."""
        return self.end[0] - self.start[0], self.end[1] - self.start[1]


@dataclass(frozen=True)
class Curve:
    """The middle line of a stroke as a curve.

    Attributes
    ----------
    points : list of (x, y)
        Points from the start to the end.
    widths : list of float
        The width at each point.
    continues : bool
        Whether the curve starts at the end of another curve.
    """

    points: list[Point]
    widths: list[float]
    continues: bool

    def outline(self, wider: float = 1.0, more: float = 0.0, aside: float = 0.0) -> list[Point]:
        """Return the corners of a band along the curve, with round ends.

        Parameters
        ----------
        wider, more
            The width is multiplied by `wider`, then `more` is added.
        aside
            The offset of the band to the left of the curve, as a share of its width.
        """
        left, right = [], []
        count = len(self.points)
        halves = [0.5 * (wider * width + more) for width in self.widths]
        for k, (x, y) in enumerate(self.points):
            (ax, ay), (bx, by) = self.points[max(k - 1, 0)], self.points[min(k + 1, count - 1)]
            length = hypot(bx - ax, by - ay) or 1.0
            across = (ay - by) / length, (bx - ax) / length
            half, shift = halves[k], aside * self.widths[k]
            left.append((x + (shift + half) * across[0], y + (shift + half) * across[1]))
            right.append((x + (shift - half) * across[0], y + (shift - half) * across[1]))
        return [*left, *_cap(left[-1], right[-1]), *right[::-1], *_cap(right[0], left[0])]


def curves(strokes: Sequence[Stroke], bend: float = 1.0) -> list[Curve]:
    """Return the curves of strokes, in their order.

    Parameters
    ----------
    strokes
        The strokes, in the order of drawing.
    bend
        1 for smooth joints, 0 for straight strokes.
    """
    ending = {(stroke.end, stroke.z): stroke for stroke in strokes}
    following = {(stroke.start, stroke.z): stroke for stroke in strokes}
    bent = []
    for stroke in strokes:
        before, after = ending.get((stroke.start, stroke.z)), following.get((stroke.end, stroke.z))
        first = stroke.along if before is None or before is stroke else _mean(before.along, stroke.along)
        last = stroke.along if after is None or after is stroke else _mean(stroke.along, after.along)
        width = stroke.width if before is None or before is stroke else before.end_width
        count = PIECES if bend else 1
        points = [_bezier(stroke, first, last, bend, k / count) for k in range(count + 1)]
        widths = [width + (stroke.end_width - width) * k / count for k in range(count + 1)]
        bent.append(Curve(points, widths, before is not None))
    return bent


def _mean(a: Point, b: Point) -> Point:
    return 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])


def _bezier(stroke: Stroke, first: Point, last: Point, bend: float, t: float) -> Point:
    """Compute a point of the curve with these tangents; with `bend` 0, a point of the straight stroke."""
    s = 1.0 - t
    weights = s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t
    first, last = _towards(stroke.along, first, bend), _towards(stroke.along, last, bend)
    corners = (
        stroke.start,
        (stroke.start[0] + first[0] / 3.0, stroke.start[1] + first[1] / 3.0),
        (stroke.end[0] - last[0] / 3.0, stroke.end[1] - last[1] / 3.0),
        stroke.end,
    )
    return (
        sum(w * x for w, (x, _) in zip(weights, corners, strict=True)),
        sum(w * y for w, (_, y) in zip(weights, corners, strict=True)),
    )


def _towards(straight: Point, tangent: Point, bend: float) -> Point:
    return (
        straight[0] + bend * (tangent[0] - straight[0]),
        straight[1] + bend * (tangent[1] - straight[1]),
    )


def _cap(start: Point, end: Point) -> list[Point]:
    """Return points of a half circle clockwise from `start` to `end`, without the ends."""
    x, y = _mean(start, end)
    u, v = start[0] - x, start[1] - y
    turns = [pi * k / ROUND for k in range(1, ROUND)]
    return [(x + u * cos(a) + v * sin(a), y + v * cos(a) - u * sin(a)) for a in turns]


def sides_of(radius: float, whole: float) -> int:
    """Return the number of sides of a circle; the error is at most a ten-thousandth of the whole drawing's size."""
    return max(48, 4 * ceil(60.0 * (radius / whole) ** 0.5)) if whole > 0.0 else 48


def ring(center: Point, along: float, across: float, angle: float, sides: int) -> list[Point]:
    """Return the corners of an ellipse, counter-clockwise; `angle` turns its first half axis."""
    turn = cos(angle), sin(angle)
    corners = []
    for k in range(sides):
        u, v = along * cos(2.0 * pi * k / sides), across * sin(2.0 * pi * k / sides)
        corners.append((center[0] + u * turn[0] - v * turn[1], center[1] + u * turn[1] + v * turn[0]))
    return corners
