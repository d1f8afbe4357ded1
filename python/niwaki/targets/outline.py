"""Outlines from files: a polygon of the plane from JSON or SVG, for `polygon_contains` and its like.

JSON: a list of points `[[x, y], ...]`, or an object with such a list under `polygon`. SVG: the first `<polygon>` or
`<path>`, of straight lines only (`M L H V Z`, small letters too); the page's y points down and is turned, so that the
plan stands upright. Units are taken as they are.
"""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as xml
from os import PathLike
from pathlib import Path

from niwaki.errors import FileError
from niwaki.words.polygons import polygon_area
from niwaki.words.vectors import Vec

Point = tuple[float, float]

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
        The file is missing or of another format; its outline is open to doubt: fewer than three corners, curves,
        numbers that are not finite, an outline that crosses itself.
    """
    place = Path(path)
    if place.suffix.lower() not in FORMATS:
        shown = place.suffix or "no suffix"
        raise FileError("file-format", path, suffix=shown, done="read", formats=", ".join(FORMATS))
    try:
        text = place.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise FileError("file-missing", path, absolute=place.absolute(), folder=Path.cwd()) from None
    except (OSError, UnicodeDecodeError) as error:
        raise FileError("file-unreadable", path, suffix=place.suffix, reason=str(error)) from error
    try:
        points = _from_json(text) if place.suffix.lower() == ".json" else _from_svg(text)
        corners = _checked(points)
    except _Unusable as reason:
        raise FileError("polygon", path, reason=str(reason)) from None
    return tuple(Vec(corner) for corner in corners)


class _Unusable(Exception):
    """Why a file holds no polygon."""


def _from_json(text: str) -> list[Point]:
    try:
        found = json.loads(text)
    except json.JSONDecodeError as error:
        raise _Unusable(f"it is no JSON: {error}") from None
    if isinstance(found, dict):
        found = found.get("polygon")
    if not isinstance(found, list):
        raise _Unusable("there is no list of points, nor an object with one under `polygon`")
    points: list[Point] = []
    for number, point in enumerate(found):
        numbers = isinstance(point, list) and len(point) == 2
        if not numbers or not all(isinstance(part, (int, float)) for part in point):
            raise _Unusable(f"point number {number} is {json.dumps(point)}, expected two numbers")
        points.append((float(point[0]), float(point[1])))
    return points


def _from_svg(text: str) -> list[Point]:
    try:
        root = xml.fromstring(text)
    except xml.ParseError as error:
        raise _Unusable(f"it is no SVG: {error}") from None
    for element in root.iter():
        kind = str(element.tag).rpartition("}")[2]
        if kind in ("polygon", "path") and any(part.get("transform") for part in root.iter()):
            raise _Unusable("the drawing has a `transform`; apply it in the program that wrote the file")
        if kind == "polygon":
            numbers = [_number(word) for word in re.split(r"[\s,]+", (element.get("points") or "").strip())]
            return [(x, -y) for x, y in zip(numbers[::2], numbers[1::2], strict=False)]
        if kind == "path":
            return [(x, -y) for x, y in _path(element.get("d") or "")]
    raise _Unusable("there is no `<polygon>` and no `<path>`")


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise _Unusable(f"{word!r} is not a number") from None


def _path(commands: str) -> list[Point]:
    """The corners of a path of one outline (SVG 1.1, 8.3)."""
    words = re.findall(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", commands)
    points: list[Point] = []
    x, y, command, at, closed = 0.0, 0.0, "", 0, False
    while at < len(words):
        if words[at].isalpha():
            command = words[at]
            at += 1
            if command.upper() not in "MLHVZ":
                raise _Unusable(f"the path has a curve, `{command}`")
            if command in "Zz":
                closed = True
                continue
            if command in "Mm" and points:
                raise _Unusable("the path has more than one outline")
        if closed or not command:
            raise _Unusable("the path has more than one outline")
        wide, relative = 1 if command in "HhVv" else 2, command.islower()
        numbers = [_number(word) for word in words[at : at + wide]]
        if len(numbers) < wide:
            raise _Unusable("the path ends in the middle of a point")
        at += wide
        if command in "Hh":
            x = numbers[0] + (x if relative else 0.0)
        elif command in "Vv":
            y = numbers[0] + (y if relative else 0.0)
        else:
            x, y = (numbers[0] + (x if relative else 0.0), numbers[1] + (y if relative else 0.0))
        points.append((x, y))
    return points


def _checked(points: list[Point]) -> list[Point]:
    """The corners counter-clockwise, without repeated points; refused where they make no simple polygon."""
    if not all(math.isfinite(part) for point in points for part in point):
        raise _Unusable("a coordinate is not a finite number")
    kept = [point for at, point in enumerate(points) if point != points[at - 1] or len(points) == 1]
    if len(kept) < 3:
        raise _Unusable(f"it has {len(kept)} corner{'s' * (len(kept) != 1)}, expected at least 3")
    count = len(kept)
    for i in range(count):
        for j in range(i + 1, count):
            neighbours = j == i + 1 or (i == 0 and j == count - 1)
            if not neighbours and _cross(kept[i], kept[(i + 1) % count], kept[j], kept[(j + 1) % count]):
                raise _Unusable(f"its edges {i + 1} and {j + 1} cross")
    if polygon_area(kept) == 0.0:
        raise _Unusable("its corners lie on one line")
    x, y = kept[0]
    turn = sum(
        (ax - x) * (by - y) - (ay - y) * (bx - x)
        for (ax, ay), (bx, by) in zip(kept, [*kept[1:], kept[0]], strict=True)
    )
    return kept if turn > 0.0 else kept[::-1]


def _cross(a: Point, b: Point, c: Point, d: Point) -> bool:
    """Whether two edges have a point in common."""

    def side(p: Point, q: Point, r: Point) -> float:
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])

    def between(p: Point, q: Point, r: Point) -> bool:
        return min(p[0], q[0]) <= r[0] <= max(p[0], q[0]) and min(p[1], q[1]) <= r[1] <= max(p[1], q[1])

    one, two, three, four = side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)
    if one * two < 0.0 and three * four < 0.0:
        return True
    touching = ((one, a, b, c), (two, a, b, d), (three, c, d, a), (four, c, d, b))
    return any(value == 0.0 and between(p, q, r) for value, p, q, r in touching)
