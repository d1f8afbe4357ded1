"""Functions of polygons in the plane. A polygon is a list or tuple of corners, in either direction.

The first corner is not repeated at the end. Results for a polygon that crosses itself have no meaning.
`niwaki.targets.outline.load_polygon` reads a polygon from a file.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from niwaki.words.vectors import Vec, VecLike, _vec

__all__ = ["polygon_area", "polygon_contains", "polygon_disc_area", "polygon_distance", "polygon_inset"]

Polygon = Sequence[VecLike]
Point = tuple[float, float]


def polygon_area(polygon: Polygon) -> float:
    """Return the area of a polygon.

    Parameters
    ----------
    polygon
        The polygon's corners, at least three points of two numbers.
    """
    return abs(_twice(_corners(polygon)) * 0.5)


def polygon_contains(polygon: Polygon, point: VecLike) -> bool:
    """Return whether a point is inside a polygon.

    Parameters
    ----------
    polygon
        The polygon's corners.
    point
        Two numbers.
    """
    x, y = _point(point)
    inside = False
    for (ax, ay), (bx, by) in _edges(_corners(polygon)):
        if (ay > y) != (by > y):
            inside = inside != (x < ax + (y - ay) / (by - ay) * (bx - ax))
    return inside


def polygon_distance(polygon: Polygon, point: VecLike) -> float:
    """Return the distance from a point, inside or outside, to the boundary of a polygon.

    Parameters
    ----------
    polygon
        The polygon's corners.
    point
        Two numbers.
    """
    x, y = _point(point)
    least = math.inf
    for (ax, ay), (bx, by) in _edges(_corners(polygon)):
        ex, ey, fx, fy = bx - ax, by - ay, x - ax, y - ay
        length = ex * ex + ey * ey
        t = 0.0 if length == 0.0 else (fx * ex + fy * ey) / length
        t = min(max(t, 0.0), 1.0)
        dx, dy = fx - ex * t, fy - ey * t
        least = min(least, dx * dx + dy * dy)
    return math.sqrt(least)


def polygon_disc_area(polygon: Polygon, center: VecLike, radius: float) -> float:
    """Return the area of the intersection of a polygon and a disc.

    Parameters
    ----------
    polygon
        The polygon's corners.
    center, radius
        The disc's centre and radius.
    """
    corners, (x, y) = _corners(polygon), _point(center)
    if radius <= 0.0:
        return 0.0

    def sector(a: Point, b: Point) -> float:
        return radius * radius * 0.5 * math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])

    total = 0.0
    for (ax, ay), (bx, by) in _edges(corners):
        a, b = (ax - x, ay - y), (bx - x, by - y)
        ex, ey = b[0] - a[0], b[1] - a[1]
        square = ex * ex + ey * ey
        if square == 0.0:
            continue
        middle = -((a[0] * ex + a[1] * ey) / square)
        discriminant = middle * middle - (a[0] * a[0] + a[1] * a[1] - radius * radius) / square
        if discriminant <= 0.0:
            total = total + sector(a, b)
            continue
        reach = math.sqrt(discriminant)
        enter, leave = min(max(middle - reach, 0.0), 1.0), min(max(middle + reach, 0.0), 1.0)
        if enter >= leave:
            total = total + sector(a, b)
            continue
        p = (a[0] + ex * enter, a[1] + ey * enter)
        q = (a[0] + ex * leave, a[1] + ey * leave)
        before = sector(a, p) if enter > 0.0 else 0.0
        after = sector(q, b) if leave < 1.0 else 0.0
        total = total + before + (p[0] * q[1] - p[1] * q[0]) * 0.5 + after
    return abs(total)


def polygon_inset(polygon: Polygon, by: float) -> list[Vec]:
    """Return the polygon with every edge moved inwards, and mitred corners.

    Parameters
    ----------
    polygon
        The polygon's corners.
    by
        The distance, negative for outwards. A distance at which an edge vanishes is an error.
    """
    corners = _corners(polygon)
    turn = _twice(corners)
    inset = _inset(corners, by if turn > 0.0 else -by) if turn != 0.0 else None
    if inset is None:
        raise ValueError(f"moved inwards by {by}, an edge of the polygon vanishes")
    return [Vec(corner) for corner in inset]


def _inset(corners: list[Point], by: float) -> list[Point] | None:
    lines: list[tuple[Point, float]] = []
    for (ax, ay), (bx, by_) in _edges(corners):
        ex, ey = bx - ax, by_ - ay
        square = ex * ex + ey * ey
        if square == 0.0:
            return None
        length = math.sqrt(square)
        nx, ny = -(ey / length), ex / length
        lines.append(((nx, ny), nx * ax + ny * ay + by))
    inset: list[Point] = []
    for at, ((kx, ky), q) in enumerate(lines):
        (mx, my), p = lines[at - 1]
        sine = mx * ky - my * kx
        if abs(sine) >= 1e-12:
            inset.append(((p * ky - q * my) / sine, (q * mx - p * kx) / sine))
        elif mx * kx + my * ky < 0.0:
            return None
        else:
            inset.append((corners[at][0] + kx * by, corners[at][1] + ky * by))
    for ((ax, ay), (bx, by_)), ((cx, cy), (dx, dy)) in zip(_edges(corners), _edges(inset), strict=True):
        if not (bx - ax) * (dx - cx) + (by_ - ay) * (dy - cy) > 0.0:
            return None
    return inset


def _edges(corners: list[Point]) -> Iterator[tuple[Point, Point]]:
    return zip(corners, [*corners[1:], corners[0]], strict=True)


def _twice(corners: list[Point]) -> float:
    """Return twice the area, positive for counter-clockwise corners."""
    x, y = corners[0]
    total = 0.0
    for (ax, ay), (bx, by) in _edges(corners):
        total = total + ((ax - x) * (by - y) - (ay - y) * (bx - x))
    return total


def _point(value: VecLike) -> Point:
    parts = _vec(value).parts
    if len(parts) != 2:
        raise TypeError(f"a point of the plane has 2 numbers, found {len(parts)}")
    return (parts[0], parts[1])


def _corners(polygon: Polygon) -> list[Point]:
    if not isinstance(polygon, (list, tuple)):
        raise TypeError(f"a polygon is a list or tuple of points, found {polygon!r}")
    if len(polygon) < 3:
        raise ValueError(f"a polygon has at least 3 corners, found {len(polygon)}")
    return [_point(corner) for corner in polygon]
