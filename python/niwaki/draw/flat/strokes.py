"""Strokes that continue one another, drawn as smooth curves that taper.

A stroke continues another when it starts where that one ends. Each becomes a cubic Bezier curve between its ends; the
tangent at a joint is the mean of the two strokes that meet there, a third of it the distance of the control point. At a
fork the curve goes on into the last of the strokes, and the others leave it. Widths change evenly from one end to
the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, cos, hypot, pi, sin

Point = tuple[float, float]

#: Straight pieces of a curve.
PIECES = 20
#: Straight pieces of a round end, for a half turn.
ROUND = 10


@dataclass(frozen=True)
class Stroke:
    """A stroke of a scene.

    Attributes
    ----------
    address : str
        Of its part.
    start, end : (x, y)
        Scene units.
    width, end_width : float
        Scene units.
    z : float
        What it lies in front of.
    """

    address: str
    start: Point
    end: Point
    width: float
    end_width: float
    z: float = 0.0

    @property
    def along(self) -> Point:
        """From its start to its end."""
        return self.end[0] - self.start[0], self.end[1] - self.start[1]


@dataclass(frozen=True)
class Curve:
    """The middle line of a stroke as a curve.

    Attributes
    ----------
    points : list of (x, y)
        From its start to its end.
    widths : list of float
        At each point.
    continues : bool
        Whether it starts at the end of another.
    """

    points: list[Point]
    widths: list[float]
    continues: bool

    def outline(self, wider: float = 1.0, more: float = 0.0, aside: float = 0.0) -> list[Point]:
        """The corners of a band along the curve, with round ends.

        Parameters
        ----------
        wider, more
            The width is multiplied by `wider`, then `more` is added.
        aside
            How far the band lies to the left of the curve, as a share of its width.
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
    """The curves of strokes, in their order.

    Parameters
    ----------
    strokes
        Those that lie on one plane, in the order in which they were drawn.
    bend
        1 for smooth joints, 0 for straight strokes.
    """
    ending = {(one.end, one.z): one for one in strokes}
    following = {(one.start, one.z): one for one in strokes}
    made = []
    for one in strokes:
        before, after = ending.get((one.start, one.z)), following.get((one.end, one.z))
        first = one.along if before is None or before is one else _mean(before.along, one.along)
        last = one.along if after is None or after is one else _mean(one.along, after.along)
        width = one.width if before is None or before is one else before.end_width
        count = PIECES if bend else 1
        points = [_bezier(one, first, last, bend, k / count) for k in range(count + 1)]
        widths = [width + (one.end_width - width) * k / count for k in range(count + 1)]
        made.append(Curve(points, widths, before is not None))
    return made


def _mean(a: Point, b: Point) -> Point:
    return 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])


def _bezier(one: Stroke, first: Point, last: Point, bend: float, t: float) -> Point:
    """A point of the curve with those tangents; with `bend` 0 a point of the straight stroke."""
    s = 1.0 - t
    weights = s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t
    first, last = _towards(one.along, first, bend), _towards(one.along, last, bend)
    corners = (
        one.start,
        (one.start[0] + first[0] / 3.0, one.start[1] + first[1] / 3.0),
        (one.end[0] - last[0] / 3.0, one.end[1] - last[1] / 3.0),
        one.end,
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
    """Points of a half circle clockwise from `start` to `end`, without both."""
    x, y = _mean(start, end)
    u, v = start[0] - x, start[1] - y
    turns = [pi * k / ROUND for k in range(1, ROUND)]
    return [(x + u * cos(a) + v * sin(a), y + v * cos(a) - u * sin(a)) for a in turns]


def sides_of(radius: float, whole: float) -> int:
    """How many sides a circle has: enough to miss it by a ten-thousandth of the whole drawing's size at most."""
    return max(48, 4 * ceil(60.0 * (radius / whole) ** 0.5)) if whole > 0.0 else 48


def ring(center: Point, along: float, across: float, angle: float, sides: int) -> list[Point]:
    """Corners of an ellipse with those half axes, the first turned by `angle`, counter-clockwise."""
    turn = cos(angle), sin(angle)
    made = []
    for k in range(sides):
        u, v = along * cos(2.0 * pi * k / sides), across * sin(2.0 * pi * k / sides)
        made.append((center[0] + u * turn[0] - v * turn[1], center[1] + u * turn[1] + v * turn[0]))
    return made
