"""Triangles of STL files, binary and text."""

from __future__ import annotations

import re
import struct

import numpy as np

from niwaki.errors import FileError
from niwaki.inputs.texts import lines_of, numbers_of
from niwaki.targets import polygons
from niwaki.targets.pieces import Arrays, Unreadable

_HEAD = 84
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def is_text(data: bytes) -> bool:
    """Return whether a file is text.

    Raises
    ------
    Unreadable
        The file is not text, and its head announces another length.
    """
    count = struct.unpack_from("<I", data, _HEAD - 4)[0] if len(data) >= _HEAD else 0
    size = count * _TRIANGLE.itemsize
    follow = len(data) - _HEAD
    if follow == size >= 0:
        return False
    # A binary file may begin with `solid` as well; few have so many triangles that no byte here is zero.
    if b"facet" in data[:65536].lower() and b"\0" not in data[:_HEAD]:
        return True
    if follow < 0:
        raise Unreadable(f"it has {len(data)} bytes, fewer than the head of an STL file")
    # Some programs end a file with a few more bytes: too few for another triangle.
    if count == 0 or not size <= follow < size + _TRIANGLE.itemsize:
        raise Unreadable(
            f"its head announces {count:,} triangles, {size:,} bytes, and {follow:,} bytes follow"
        )
    return False


def parsed(data: bytes) -> Arrays:
    """Parse a file into vertices and triangles.

    Raises
    ------
    Unreadable
        The file is cut short, or a coordinate is no number.
    FileError
        The file has no triangles.
    """
    if is_text(data):
        return _text(lines_of(data))
    (count,) = struct.unpack_from("<I", data, _HEAD - 4)
    if count == 0:
        raise FileError("target-empty", None, reason="the file holds no object")
    corners = np.frombuffer(data, _TRIANGLE, count, _HEAD)["corners"].reshape(-1, 3)
    return corners.astype(np.float64), np.arange(len(corners)).reshape(-1, 3)


def _text(text: bytes) -> Arrays:
    text = text.lower()
    if b"endsolid" not in text:
        raise Unreadable("it has no `endsolid`: it is cut short")
    # A name may hold any words.
    text = re.sub(rb"(?m)^[^\S\n]*(?:end)?solid\b[^\n]*", b"", text)
    *loops, rest = text.split(b"endloop")
    if not loops:
        raise FileError("target-empty", None, reason="the file holds no object")
    counts = np.array([loop.count(b"vertex") for loop in loops])
    rows = re.findall(rb"vertex\s+(\S+\s+\S+\s+\S+)", text)
    corners = numbers_of(b" ".join(rows), np.float64)
    if rest.count(b"vertex") or len(rows) != counts.sum() or counts.min() < 3:
        raise Unreadable("one of its facets has fewer than three whole vertices")
    if corners is None or len(corners) != 3 * len(rows):
        wrong = next(row for row in rows if numbers_of(row, np.float64) is None)
        raise Unreadable(f"one of its vertices is {wrong.decode('latin-1')!a:.60}, expected three numbers")
    vertices = corners.reshape(-1, 3)
    return vertices, polygons.triangles(vertices, np.arange(len(vertices)), counts)
