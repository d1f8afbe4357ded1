"""Triangles of PLY files, text and binary: coordinates of vertices, and the polygons or strips over them.

The counts in the head are compared with the length of the file first. A binary file is read as bytes, a text as its
numbers; a place counts these units from the beginning.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import FileError
from niwaki.inputs.texts import numbers_of
from niwaki.targets import polygons
from niwaki.targets.pieces import Arrays, Unreadable, check_corners

#: The longest head, bytes.
_LONGEST = 1 << 16
_TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
    "float16": "f2",
    "int64": "i8",
    "uint64": "u8",
}
#: How NumPy writes the order of bytes; a text has none.
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_INDICES = ("vertex_indices", "vertex_index")

#: How `struct` writes the types of lengths.
_CODES = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "i8": "q", "u8": "Q"}

Places = NDArray[np.int64]


@dataclass
class _Property:
    """A column of an element: numbers, or lists of numbers that begin with their lengths."""

    name: str
    kind: str
    length: str | None = None


@dataclass
class _Element:
    """A table, as the head announces it."""

    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)


def check_head(data: bytes) -> None:
    """Refuse a file that is too short for what its head announces.

    Raises
    ------
    Unreadable
        The file is too short, or it has no head.
    """
    _head(data)


def parsed(data: bytes) -> Arrays:
    """Parse a file into vertices and triangles.

    Raises
    ------
    Unreadable
        The file is cut short, or a face names no vertex.
    FileError
        The file has no faces, or a concave polygon of too many corners.
    """
    order, elements, at = _head(data)
    body = _Bytes(data, order) if order else _Numbers(data[at:])
    at = at if order else 0
    vertices = np.empty((0, 3))
    polygon_table: tuple[str, Places, NDArray[np.int64]] | None = None
    for element in elements:
        table = _Table(body, element, at)
        at = table.end
        if element.name == "vertex":
            vertices = np.stack([table.numbers(axis) for axis in "xyz"], axis=1)
        elif element.name in ("face", "tristrips") and element.count:
            lists = [column.name for column in element.properties if column.length]
            known = [column for column in _INDICES if column in lists] or lists
            if len(known) != 1 or polygon_table:
                raise Unreadable("it has no single table of faces with a list `vertex_indices`")
            polygon_table = (element.name, *table.lists(known[0]))
    if polygon_table is None:
        raise FileError("target-empty", None, reason="the file holds points or curves only")
    name, counts, corners = polygon_table
    if name == "face":
        return vertices, polygons.triangles(vertices, corners, counts)
    # A strip ends at -1, or where its list does.
    faces = polygons.strips(np.insert(corners, np.cumsum(counts), -1))
    check_corners(faces, len(vertices))
    return vertices, faces


class _Body:
    """The numbers of all tables, read by their places."""

    def __init__(self, end: int) -> None:
        self.end = end

    def size(self, kind: str) -> int:
        """Return the units of a number."""
        raise NotImplementedError

    def gather(self, places: Places, kind: str) -> NDArray[Any]:
        """Return the numbers at places within the file."""
        raise NotImplementedError

    def read(self, places: Places, kind: str) -> NDArray[Any]:
        """Return the numbers at places."""
        if len(places) and not 0 <= places.min() <= places.max() <= self.end - self.size(kind):
            raise Unreadable("it is cut short")
        return self.gather(places, kind)

    def length(self, kind: str) -> Callable[[int], int]:
        """Return a function that reads the length of a list at a place."""
        raise NotImplementedError

    def whole(self, places: Places, kind: str) -> NDArray[np.int64]:
        """Return the numbers at places as integers."""
        with np.errstate(invalid="ignore"):
            return self.read(places, kind).astype(np.int64)


class _Bytes(_Body):
    """A binary file."""

    def __init__(self, data: bytes, order: str) -> None:
        super().__init__(len(data))
        self.data, self.order = data, order

    def size(self, kind: str) -> int:
        return np.dtype(kind).itemsize

    def length(self, kind: str) -> Callable[[int], int]:
        if kind == "u1":
            return self.data.__getitem__
        read = struct.Struct(self.order + _CODES[kind]).unpack_from
        return lambda at: read(self.data, at)[0]

    def gather(self, places: Places, kind: str) -> NDArray[Any]:
        # A number may begin at every byte.
        count = max(self.end - self.size(kind) + 1, 0)
        return np.ndarray((count,), np.dtype(self.order + kind), self.data, 0, (1,))[places]


class _Numbers(_Body):
    """A text file."""

    def __init__(self, text: bytes) -> None:
        numbers = numbers_of(text, np.float64)
        if numbers is None:
            raise Unreadable("its tables hold something that is no number")
        super().__init__(len(numbers))
        self.numbers = numbers

    def size(self, kind: str) -> int:
        return 1

    def length(self, kind: str) -> Callable[[int], int]:
        return lambda at: int(self.numbers.item(at))

    def gather(self, places: Places, kind: str) -> NDArray[Any]:
        with np.errstate(over="ignore"):
            return self.numbers[places].astype(kind if kind[0] == "f" else np.float64)


class _Table:
    """The rows of an element.

    Attributes
    ----------
    end : int
        The place behind the last row.
    """

    def __init__(self, body: _Body, element: _Element, at: int) -> None:
        self.body, self.element = body, element
        #: The start of each property in each row: places, and an offset from them.
        self.starts: dict[str, tuple[Places, int]] = {}
        self.counts: dict[str, NDArray[np.int64]] = {}
        try:
            # Most tables have rows of one length.
            row = int(self._laid(np.array([at]))[0]) - at if element.count else 0
            starts = at + row * np.arange(element.count)
            even = bool((self._laid(starts) == starts + row).all())
        except Unreadable:
            even = False
        ends = self._laid(starts if even else self._walked(at))
        self.end = int(ends[-1]) if len(ends) else at
        if self.end > body.end:
            raise Unreadable("it is cut short")

    def numbers(self, name: str) -> NDArray[np.float64]:
        """Return a column of numbers."""
        column = next(
            (column for column in self.element.properties if column.name == name and not column.length), None
        )
        if column is None:
            raise Unreadable(f"its vertices have no property `{name}`")
        places, offset = self.starts[name]
        return self.body.read(places + offset, column.kind).astype(np.float64)

    def lists(self, name: str) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the lengths of a column of lists, and all their numbers in order."""
        column = next(column for column in self.element.properties if column.name == name)
        places, offset = self.starts[name]
        counts = self.counts[name]
        starts = places + offset + self.body.size(str(column.length))
        within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        return counts, self.body.whole(
            np.repeat(starts, counts) + within * self.body.size(column.kind), column.kind
        )

    def _laid(self, starts: Places) -> Places:
        """Lay out rows that begin at places, and return their ends."""
        places, offset = starts, 0
        for column in self.element.properties:
            self.starts[column.name] = places, offset
            if column.length:
                counts = self.body.whole(places + offset, column.length)
                if len(counts) and not 0 <= counts.min() <= counts.max() <= self.body.end:
                    raise Unreadable("the length of a list is below zero, or beyond the end of the file")
                self.counts[column.name] = counts
                places = (
                    places + offset + self.body.size(column.length) + counts * self.body.size(column.kind)
                )
                offset = 0
            else:
                offset += self.body.size(column.kind)
        return places + offset

    def _walked(self, at: int) -> Places:
        """Walk from row to row, and return their starts."""
        steps, gap = [], 0
        for column in self.element.properties:
            if column.length:
                sizes = self.body.size(column.length), self.body.size(column.kind)
                steps.append((gap, self.body.length(column.length), *sizes))
                gap = 0
            else:
                gap += self.body.size(column.kind)
        starts = []
        try:
            for _ in range(self.element.count):
                starts.append(at)
                for before, length, size, item in steps:
                    at += before
                    at += size + item * length(at)
                at += gap
        except (IndexError, struct.error, ValueError, OverflowError):
            raise Unreadable(
                f"it is cut short in row {len(starts):,} of its table `{self.element.name:.40}`"
            ) from None
        return np.array(starts, np.int64)


def _head(data: bytes) -> tuple[str, list[_Element], int]:
    """Parse the head: the order of bytes, the tables, and the place where they begin."""
    first = re.match(rb"(?:\xef\xbb\xbf)?ply[^\S\r\n]*(\r\n|\n|\r)", data[:64], re.I)
    if first is None:
        raise Unreadable("it has no head of a PLY file")
    order: str | None = None
    elements: list[_Element] = []
    at = first.end()
    # Lines end as the first line does: the bytes after the head may look like the end of a line.
    for line in data[at:_LONGEST].split(first[1]):
        at += len(line) + len(first[1])
        words = line.decode("latin-1").split()
        match words[:1]:
            case ["format"]:
                order = _ORDERS.get(" ".join(words[1:2]))
            case ["element"]:
                elements.append(_element(words, elements))
            case ["property"] if elements:
                elements[-1].properties.append(_property(words, elements[-1]))
            case ["end_header"] if order is not None:
                _check_length(elements, order, len(data) - at)
                return order, elements, at
            case ["end_header"]:
                break
    raise Unreadable("its head does not end, or names no format")


def _element(words: list[str], elements: list[_Element]) -> _Element:
    if len(words) != 3 or not words[2].isdecimal() or len(words[2]) > 18:
        raise Unreadable(f"its head announces {' '.join(words[2:]):.40} rows")
    if any(other.name == words[1] for other in elements):
        raise Unreadable(f"its head announces `{words[1]:.40}` twice")
    return _Element(words[1], int(words[2]))


def _property(words: list[str], element: _Element) -> _Property:
    is_list = words[1:2] == ["list"]
    kinds = words[2:4] if is_list else words[1:2]
    wrong = [kind for kind in kinds if kind not in _TYPES]
    if is_list and not wrong:
        wrong = [kind for kind in kinds[:1] if _TYPES[kind] not in _CODES]
    if wrong or len(words) != (5 if is_list else 3):
        raise Unreadable(f"its head has a property of type `{' '.join(wrong or words[1:]):.40}`")
    if any(other.name == words[-1] for other in element.properties):
        raise Unreadable(f"its head announces `{words[-1]:.40}` twice")
    return _Property(words[-1], _TYPES[kinds[-1]], _TYPES[kinds[0]] if is_list else None)


def _check_length(elements: list[_Element], order: str, rest: int) -> None:
    least = 0
    for element in elements:
        if element.count and not element.properties:
            raise Unreadable("its head announces rows without properties")
        # A lower bound: the length of a list; in text a digit and a separator.
        sizes = [
            np.dtype(column.length or column.kind).itemsize if order else 2 for column in element.properties
        ]
        least += element.count * sum(sizes)
    # A text may end with its last number.
    if least > rest + (not order):
        raise Unreadable(f"its head announces at least {least:,} bytes, and {max(rest, 0):,} follow")
