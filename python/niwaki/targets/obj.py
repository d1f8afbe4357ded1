"""Triangles of OBJ files. Names, materials, textures and normals are ignored.

The text is read as bytes, so that the alphabet of its names does not matter.
"""

from __future__ import annotations

import re
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import FileError
from niwaki.inputs.texts import lines_of, numbers_of
from niwaki.targets import polygons
from niwaki.targets.pieces import Arrays, Unreadable

# `fo` is the spelling of `f` in the first version of the format.
_STATEMENTS = re.compile(rb"(?m)^[^\S\n]*(v|fo?)(?=\s)([^\n#]*)")
_CONTINUED = re.compile(rb"(?m)^[^\S\n]*(?:v|fo?)(?=[\s\\])(?:[^\n\\]+|\\[^\S\n]*\n|\\)*")


def parsed(data: bytes) -> Arrays:
    """Parse a file into vertices and triangles.

    Raises
    ------
    Unreadable
        A vertex has fewer than three numbers, or a face names no vertex.
    FileError
        The file has no faces, or a concave polygon of too many corners.
    """
    text = lines_of(data)
    if b"\\" in text:
        # The lines keep their numbers.
        text = _CONTINUED.sub(
            lambda match: re.sub(rb"\\[^\S\n]*\n", b" ", match[0]) + b"\n" * match[0].count(b"\n"), text
        )
    rows = _STATEMENTS.findall(text)
    is_vertex = np.fromiter((kind == b"v" for kind, _ in rows), bool, len(rows))
    faces = [rest for kind, rest in rows if kind != b"v"]
    if not faces:
        reason = "the file holds points or curves only" if rows else "the file holds no object"
        raise FileError("target-empty", None, reason=reason)
    vertices = _vertices([rest.split(None, 3)[:3] for kind, rest in rows if kind == b"v"], text)
    counts = np.fromiter((len(rest.split()) for rest in faces), np.int64, len(faces))
    # `7/1/3`: a vertex, its texture and its normal.
    corners = numbers_of(re.sub(rb"/\S*", b"", b" ".join(faces)), np.int64)
    if corners is None or len(corners) != counts.sum():
        pattern = re.compile(rb"(\s*[+-]?\d{1,18}(/\S*)?(?=\s|$))*\s*")
        wrong = next((k for k, rest in enumerate(faces) if not pattern.fullmatch(rest)), 0)
        raise Unreadable(
            f"{_line(text, b'f', wrong)}: a face names {_shown(faces[wrong])}, expected numbers of vertices"
        )
    corners = _numbered(corners, counts, np.cumsum(is_vertex)[~is_vertex], len(vertices), text)
    return vertices, polygons.triangles(vertices, corners, counts)


def _vertices(rows: list[list[bytes]], text: bytes) -> NDArray[np.float64]:
    numbers = numbers_of(b" ".join(token for row in rows for token in row), np.float64)
    if numbers is not None and all(len(row) == 3 for row in rows):
        return numbers.reshape(-1, 3)
    whole = (len(row) == 3 and numbers_of(b" ".join(row), np.float64) is not None for row in rows)
    wrong = next((k for k, is_whole in enumerate(whole) if not is_whole), 0)
    raise Unreadable(
        f"{_line(text, b'v', wrong)}: a vertex is {_shown(b' '.join(rows[wrong]))}, expected three numbers"
    )


def _numbered(
    corners: NDArray[np.int64], counts: NDArray[np.int64], before: NDArray[np.int64], total: int, text: bytes
) -> NDArray[np.int64]:
    """Return vertex numbers from 0. A number below 0 counts back from the last vertex before the face."""
    numbers = np.where(corners > 0, corners - 1, np.repeat(before, counts) + corners)
    wrong = np.flatnonzero((corners == 0) | (numbers < 0) | (numbers >= total))
    if len(wrong):
        face = int(np.searchsorted(np.cumsum(counts), wrong[0], side="right"))
        number = int(corners[wrong[0]])
        reason = f"there are {before[face] if number < 0 else total}, counted from 1"
        if number == 0:
            reason = "vertices are counted from 1; where a program counted from 0, add 1 to all numbers of lines `f`"
        raise Unreadable(f"{_line(text, b'f', face)}: a face names vertex {number}, and {reason}")
    return numbers


def _line(text: bytes, kind: bytes, number: int) -> str:
    """Return the line of the vertex or the face of a number."""
    alike = (match for match in _STATEMENTS.finditer(text) if match[1][:1] == kind)
    before = text.count(b"\n", 0, next(islice(alike, number, None)).start(1))
    return f"line {before + 1}"


def _shown(text: bytes) -> str:
    return f"`{ascii(text.strip().decode('latin-1'))[1:-1]:.40}`"
