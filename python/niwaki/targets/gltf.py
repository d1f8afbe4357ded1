"""The triangles of glTF 2.0 files, .glb and .gltf, each mesh as its nodes place it.

Only positions, indices and nodes are read; materials, images and animations are not opened. Every count and every place
is held against the bytes that are there before anything is allocated.
"""

from __future__ import annotations

import base64
import binascii
import struct
from collections.abc import Callable, Iterator
from typing import Any
from urllib.parse import unquote_to_bytes, urlsplit

import numpy as np
from numpy.typing import NDArray

from niwaki.inputs.limits import beyond, check, limit
from niwaki.inputs.texts import json_of

Arrays = tuple[NDArray[np.float64], NDArray[np.int64]]

_MAGIC, _JSON, _BIN = 0x46546C67, 0x4E4F534A, 0x004E4942
_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_INDICES = (5121, 5123, 5125)
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_HUGE = 1 << 40


class Unreadable(Exception):
    """Why a file is no glTF that can be read."""


def parsed(data: bytes, suffix: str, beside: Callable[[str], bytes]) -> list[Arrays]:
    """Vertices and faces of each mesh that a file places, in the order of its nodes.

    Parameters
    ----------
    data
        The file.
    suffix
        ".glb" or ".gltf".
    beside
        Gives the bytes of a file that this one names.

    Raises
    ------
    Unreadable
        It is no glTF 2.0, or uses what is not read.
    FileError
        It holds more than is read.
    """
    text, chunk = _chunks(data) if suffix == ".glb" else (data, b"")
    try:
        tree = _table(json_of(text.decode("utf-8-sig"), None, suffix), "the file")
    except UnicodeDecodeError as error:
        raise Unreadable(f"its JSON is no text: {error}") from error
    version = _table(tree.get("asset", {}), "`asset`").get("version", "2.0")
    if not str(version).startswith("2"):
        raise Unreadable(f"it is glTF {version!s:.20}; only version 2 is read")
    return _File(tree, chunk, beside).placed()


class _File:
    """A file taken apart."""

    def __init__(self, tree: dict[str, Any], chunk: bytes, beside: Callable[[str], bytes]) -> None:
        self.nodes, self.meshes = _tables(tree, "nodes"), _tables(tree, "meshes")
        self.scenes, self.scene = _tables(tree, "scenes"), tree.get("scene", 0)
        self.accessors, self.views = _tables(tree, "accessors"), _tables(tree, "bufferViews")
        check("nodes", len(self.nodes), None)
        self.buffers = [
            _buffer(one, chunk if k == 0 else b"", beside) for k, one in enumerate(_tables(tree, "buffers"))
        ]
        self.read: dict[int, list[Arrays]] = {}

    def placed(self) -> list[Arrays]:
        """Every mesh of every node."""
        found: list[Arrays] = []
        allowed = 4 * sum(map(len, self.buffers)) + limit("copies")
        numbers = 0
        for mesh, matrix in self.walk():
            if mesh not in self.read:
                self.read[mesh] = list(self.primitives(mesh))
            for vertices, faces in self.read[mesh]:
                numbers += len(vertices) + faces.size
                if numbers > allowed:
                    raise beyond("copies", f"its {len(self.nodes):,} nodes place more", None)
                if len(found) == limit("nodes"):
                    raise beyond("nodes", f"it places more than {len(found):,} meshes", None)
                if not np.array_equal(matrix, np.eye(4)):
                    with np.errstate(all="ignore"):
                        vertices = vertices @ matrix[:3, :3].T + matrix[:3, 3]
                        # A mirror image turns its triangles over.
                        faces = faces[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0.0 else faces
                found.append((vertices, faces))
        return found

    def walk(self) -> Iterator[tuple[int, NDArray[np.float64]]]:
        """The mesh and the place of each node, parents before their children, in order."""
        if self.scenes:
            roots = _list(self.scenes[_index(self.scene, self.scenes, "scene")].get("nodes", []), "`nodes`")
        else:
            children = [one for node in self.nodes for one in _list(node.get("children", []), "`children`")]
            below = {one for one in children if isinstance(one, int)}
            roots = [number for number in range(len(self.nodes)) if number not in below]
        waiting = [(root, np.eye(4)) for root in reversed(roots)]
        seen: set[int] = set()
        while waiting:
            given, above = waiting.pop()
            number = _index(given, self.nodes, "node")
            if number in seen:
                raise Unreadable(f"node {number} has two parents, or is below itself")
            seen.add(number)
            node = self.nodes[number]
            with np.errstate(all="ignore"):
                matrix = above @ _matrix(node)
            waiting += [(child, matrix) for child in reversed(_list(node.get("children", []), "`children`"))]
            if "mesh" in node:
                yield _index(node["mesh"], self.meshes, "mesh"), matrix

    def primitives(self, mesh: int) -> Iterator[Arrays]:
        """Vertices and faces of each part of a mesh that has triangles."""
        for one in _tables(self.meshes[mesh], "primitives"):
            mode = one.get("mode", _TRIANGLES)
            if mode not in (_TRIANGLES, _STRIP, _FAN):
                continue
            places = _table(one.get("attributes", {}), "`attributes`")
            if "POSITION" not in places:
                continue
            vertices = self.numbers(places["POSITION"], 3).astype(np.float64)
            if "indices" in one:
                flat = self.numbers(one["indices"], 1).reshape(-1).astype(np.int64)
            else:
                flat = np.arange(len(vertices))
            yield vertices, _triangles(flat, mode)

    def numbers(self, given: Any, columns: int) -> NDArray[Any]:
        """The numbers of an accessor, (count, columns): positions, or indices of one column."""
        accessor = self.accessors[_index(given, self.accessors, "accessor")]
        expected = "VEC3" if columns == 3 else "SCALAR"
        kind, code = accessor.get("type"), accessor.get("componentType")
        if (
            kind != expected
            or not isinstance(code, int)
            or code not in (_TYPES if columns == 3 else _INDICES)
        ):
            raise Unreadable(f"accessor {given} has type {kind!s:.20} {code!s:.20}, expected {expected}")
        if "bufferView" not in accessor or "sparse" in accessor:
            raise Unreadable("its meshes are compressed (Draco) or sparse; export them without compression")
        view = self.views[_index(accessor["bufferView"], self.views, "bufferView")]
        if any("meshopt" in name for name in _table(view.get("extensions", {}), "`extensions`")):
            raise Unreadable("its meshes are compressed (meshopt); export them without compression")
        buffer = self.buffers[_index(view.get("buffer"), self.buffers, "buffer")]
        dtype = np.dtype(_TYPES[code])
        row = columns * dtype.itemsize
        start, length = (
            _whole(view.get("byteOffset", 0), "byteOffset"),
            _whole(view.get("byteLength"), "byteLength"),
        )
        count, offset = (
            _whole(accessor.get("count"), "count"),
            _whole(accessor.get("byteOffset", 0), "byteOffset"),
        )
        stride = _whole(view.get("byteStride", row), "byteStride")
        if start + length > len(buffer):
            raise Unreadable(f"a view ends at byte {start + length:,} of a buffer that has {len(buffer):,}")
        if count == 0:
            return np.empty((0, columns), dtype)
        if stride < row or offset + (count - 1) * stride + row > length:
            raise Unreadable(f"accessor {given} names {count:,} rows, and its view has {length:,} bytes")
        found = np.ndarray((count, columns), dtype, buffer, start + offset, (stride, dtype.itemsize))
        if dtype.kind != "f" and columns == 3 and accessor.get("normalized") is True:
            return np.maximum(found / np.iinfo(dtype).max, -1.0)
        return found


def _chunks(data: bytes) -> tuple[bytes, bytes]:
    """The JSON of a .glb file, and its first binary chunk."""
    if len(data) < 20 or struct.unpack_from("<I", data)[0] != _MAGIC:
        raise Unreadable("it does not begin as a .glb file does")
    version, total = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise Unreadable(f"it is glTF {version}; only version 2 is read")
    if total > len(data):
        raise Unreadable(f"it should have {total:,} bytes and has {len(data):,}: it is cut short")
    at = 12
    found: dict[int, bytes] = {}
    while at + 8 <= total:
        length, kind = struct.unpack_from("<II", data, at)
        if at + 8 + length > total:
            raise Unreadable(f"a chunk of {length:,} bytes does not fit into the file")
        found.setdefault(kind, data[at + 8 : at + 8 + length])
        at += 8 + length
    if _JSON not in found:
        raise Unreadable("it has no JSON chunk")
    return found[_JSON], found.get(_BIN, b"")


def _buffer(table: dict[str, Any], chunk: bytes, beside: Callable[[str], bytes]) -> bytes:
    uri = table.get("uri")
    if uri is None:
        return chunk
    if not isinstance(uri, str):
        raise Unreadable("the `uri` of a buffer is no text")
    if not uri.startswith("data:"):
        return beside(uri)
    head, comma, body = uri.partition(",")
    try:
        return base64.b64decode(body, validate=True) if head.endswith(";base64") else unquote_to_bytes(body)
    except (binascii.Error, ValueError) as error:
        raise Unreadable(f"a buffer in the file is no base64: {error}") from error


def name_of(uri: str) -> str:
    """The name of a file in or below the folder of the file that names it.

    Raises
    ------
    Unreadable
        It is an address elsewhere.
    """
    try:
        name = unquote_to_bytes(uri).decode()
        parts = urlsplit(uri)
    except ValueError:
        raise Unreadable(f"{uri!a:.80} is no name of a file") from None
    words = name.replace("\\", "/").split("/")
    if (
        parts.scheme
        or parts.netloc
        or name.startswith(("/", "\\"))
        or ".." in words
        or ":" in words[0]
        or "\0" in name
    ):
        raise Unreadable(f"it names {uri!a:.80}; only files in its own folder are read")
    return name


def _matrix(node: dict[str, Any]) -> NDArray[np.float64]:
    if "matrix" in node:
        return _floats(node["matrix"], 16, "matrix").reshape(4, 4).T
    x, y, z, w = _floats(node.get("rotation", [0, 0, 0, 1]), 4, "rotation")
    length = float(np.sqrt(x * x + y * y + z * z + w * w)) or 1.0
    x, y, z, w = x / length, y / length, z / length, w / length
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    found = np.eye(4)
    found[:3, :3] = turn * _floats(node.get("scale", [1, 1, 1]), 3, "scale")
    found[:3, 3] = _floats(node.get("translation", [0, 0, 0]), 3, "translation")
    return found


def _triangles(flat: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    if mode == _TRIANGLES:
        if len(flat) % 3:
            raise Unreadable(f"{len(flat)} indices make no triangles")
        return flat.reshape(-1, 3)
    if len(flat) < 3:
        return np.empty((0, 3), np.int64)
    if mode == _FAN:
        return np.stack([np.full(len(flat) - 2, flat[0]), flat[1:-1], flat[2:]], axis=1)
    found = np.stack([flat[:-2], flat[1:-1], flat[2:]], axis=1)
    found[1::2] = found[1::2, [1, 0, 2]]
    return found


def _table(value: Any, name: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise Unreadable(f"{name} is no table")
    return value


def _list(value: Any, name: str) -> list[Any]:
    if not isinstance(value, list):
        raise Unreadable(f"{name} is no list")
    return value


def _tables(tree: dict[str, Any], name: str) -> list[dict[str, Any]]:
    return [_table(one, f"an entry of `{name}`") for one in _list(tree.get(name, []), f"`{name}`")]


def _index(value: Any, rows: list[Any], name: str) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < len(rows):
        raise Unreadable(f"it names {name} {value!r:.40}, and has {len(rows)}")
    return value


def _whole(value: Any, name: str) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < _HUGE:
        raise Unreadable(f"`{name}` is {value!r:.40}, expected a whole number from 0")
    return value


def _floats(value: Any, count: int, name: str) -> NDArray[np.float64]:
    numbers = value if isinstance(value, list) else []
    if len(numbers) != count or not all(isinstance(one, (int, float)) for one in numbers):
        raise Unreadable(f"a node's `{name}` is not {count} numbers")
    return np.array(numbers, dtype=np.float64)
