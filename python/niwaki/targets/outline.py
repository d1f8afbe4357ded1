"""Outlines from files: a polygon of the plane from JSON or SVG, for `polygon_contains` and similar words.

JSON: a list of points `[[x, y], ...]`, or an object with such a list under `polygon`. SVG: the first `<polygon>` or
`<path>`, of straight lines only (`M L H V Z`, small letters too); the page's y points down and is negated, so that the
plan is upright. Units are those of the file.
"""

from __future__ import annotations

import json
import math
import re
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import FileError
from niwaki.errors.settings import is_number
from niwaki.inputs import text_of
from niwaki.inputs.limits import check
from niwaki.inputs.texts import json_of
from niwaki.inputs.xml import xml_of
from niwaki.words.polygons import polygon_area
from niwaki.words.vectors import Vec

Point = tuple[float, float]
Points = NDArray[np.float64]

#: No coordinate is farther from 0: areas stay finite.
FARTHEST = 1e100

FORMATS = (".json", ".svg")


def load_polygon(path: str | PathLike[str]) -> tuple[Vec, ...]:
    """Read a polygon from a file whose name ends in .json or .svg.

    Parameters
    ----------
    path
        The file.

    Returns
    -------
    tuple of Vec
        The corners, counter-clockwise, the first one not repeated: data that a model may use.

    Raises
    ------
    FileError
        The file is missing or of another format, or its outline is not usable: fewer than three corners, curves,
        numbers that are not finite, an outline that crosses itself.
    """
    place = Path(path)
    if place.suffix.lower() not in FORMATS:
        shown = place.suffix or "no suffix"
        raise FileError("file-format", path, suffix=shown, done="read", formats=", ".join(FORMATS))
    text = text_of(path, "outline", place.suffix)
    try:
        points = _from_json(text, path) if place.suffix.lower() == ".json" else _from_svg(text, path)
        check("corners", len(points), path)
        corners = _checked(points)
    except _Unusable as reason:
        raise FileError("polygon", path, reason=str(reason)) from None
    return tuple(Vec(corner) for corner in corners)


class _Unusable(Exception):
    """A file without a usable polygon. The text is the reason."""


def _from_json(text: str, path: str | PathLike[str]) -> list[Point]:
    try:
        content = json_of(text, path)
    except FileError as error:
        if error.code != "file-unreadable":
            raise
        raise _Unusable(f"it is no JSON: {error.values['reason']}") from error
    if isinstance(content, dict):
        content = content.get("polygon")
    if not isinstance(content, list):
        raise _Unusable("there is no list of points, nor an object with one under `polygon`")
    points: list[Point] = []
    for number, point in enumerate(content):
        numbers = isinstance(point, list) and len(point) == 2
        if not numbers or not all(is_number(part) for part in point):
            raise _Unusable(f"point number {number} is {json.dumps(point):.60}, expected two numbers")
        points.append((float(point[0]), float(point[1])))
    return points


def _from_svg(text: str, path: str | PathLike[str]) -> list[Point]:
    try:
        root = xml_of(text.encode(), path).root
    except FileError as error:
        if error.code != "file-unreadable":
            raise
        raise _Unusable(f"it is no SVG: {error.values['reason']}") from error
    for element in root.iter():
        kind = str(element.tag).rpartition("}")[2]
        if kind in ("polygon", "path") and any(part.get("transform") for part in root.iter()):
            raise _Unusable("the drawing has a `transform`; apply it in the program that wrote the file")
        if kind == "polygon":
            numbers = [_number(word) for word in re.split(r"[\s,]+", (element.get("points") or "").strip())]
            if len(numbers) % 2:
                raise _Unusable("its last point has one number")
            return [(x, -y) for x, y in zip(numbers[::2], numbers[1::2], strict=False)]
        if kind == "path":
            return [(x, -y) for x, y in _path(element.get("d") or "")]
    raise _Unusable("there is no `<polygon>` and no `<path>`")


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise _Unusable(f"{word!r:.60} is not a number") from None


def _path(commands: str) -> list[Point]:
    """Return the corners of a path of one outline (SVG 1.1, 8.3)."""
    words = re.findall(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", commands)
    points: list[Point] = []
    x, y, command, at, is_closed = 0.0, 0.0, "", 0, False
    while at < len(words):
        if words[at].isalpha():
            command = words[at]
            at += 1
            if command.upper() not in "MLHVZ":
                raise _Unusable(f"the path has a curve, `{command}`")
            if command in "Zz":
                is_closed = True
                continue
            if command in "Mm" and points:
                raise _Unusable("the path has more than one outline")
        if is_closed or not command:
            raise _Unusable("the path has more than one outline")
        count, is_relative = 1 if command in "HhVv" else 2, command.islower()
        numbers = [_number(word) for word in words[at : at + count]]
        if len(numbers) < count:
            raise _Unusable("the path ends in the middle of a point")
        at += count
        if command in "Hh":
            x = numbers[0] + (x if is_relative else 0.0)
        elif command in "Vv":
            y = numbers[0] + (y if is_relative else 0.0)
        else:
            x, y = (numbers[0] + (x if is_relative else 0.0), numbers[1] + (y if is_relative else 0.0))
        points.append((x, y))
    return points


def _checked(points: list[Point]) -> list[Point]:
    """Return the corners counter-clockwise, without repeated points. Refuse corners that make no simple polygon."""
    if not all(math.isfinite(part) for point in points for part in point):
        raise _Unusable("a coordinate is not a finite number")
    corners = [point for at, point in enumerate(points) if point != points[at - 1] or len(points) == 1]
    if len(corners) < 3:
        raise _Unusable(f"it has {len(corners)} corner{'s' * (len(corners) != 1)}, expected at least 3")
    if max(abs(part) for point in corners for part in point) > FARTHEST:
        raise _Unusable(f"a coordinate is more than {FARTHEST:g} from 0")
    crossing = _crossing(np.array(corners))
    if crossing is not None:
        raise _Unusable(f"its edges {crossing[0] + 1} and {crossing[1] + 1} cross")
    if polygon_area(corners) == 0.0:
        raise _Unusable("its corners lie on one line")
    x, y = corners[0]
    turn = sum(
        (ax - x) * (by - y) - (ay - y) * (bx - x)
        for (ax, ay), (bx, by) in zip(corners, [*corners[1:], corners[0]], strict=True)
    )
    return corners if turn > 0.0 else corners[::-1]


def _crossing(corners: NDArray[np.float64]) -> tuple[int, int] | None:
    """Find the first two edges that have a point in common and are no neighbours."""
    starts, ends = corners, np.roll(corners, -1, axis=0)
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    count = len(corners)
    for i in range(count - 2):
        # Neighbours always meet. The last edge is a neighbour of the first.
        last = count - 1 if i == 0 else count
        boxes = (low[i + 2 : last] <= high[i]) & (low[i] <= high[i + 2 : last])
        near = np.flatnonzero(boxes.all(axis=1)) + i + 2
        if len(near) and (met := np.flatnonzero(_cross(starts[i], ends[i], starts[near], ends[near]))).size:
            return i, int(near[met[0]])
    return None


def _cross(a: Points, b: Points, c: Points, d: Points) -> NDArray[np.bool_]:
    """Return whether an edge meets each of several edges whose boxes meet its box."""

    def side(p: Points, q: Points, r: Points) -> NDArray[np.float64]:
        return np.asarray(
            (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1])
            - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])
        )

    def between(p: Points, q: Points, r: Points) -> NDArray[np.bool_]:
        return np.asarray(((np.minimum(p, q) <= r) & (r <= np.maximum(p, q))).all(axis=-1))

    side_c, side_d, side_a, side_b = side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)
    crossing = (side_c * side_d < 0.0) & (side_a * side_b < 0.0)
    for value, p, q, r in ((side_c, a, b, c), (side_d, a, b, d), (side_a, c, d, a), (side_b, c, d, b)):
        crossing |= (value == 0.0) & between(p, q, r)
    return crossing
