"""Triangles of glTF 2.0 files, .glb and .gltf. Nodes place the meshes.

Only shapes are read, in the pose at rest: positions, moved by weights and bones; indices, nodes and instances.
Materials, images and animations are not opened. Every count and every place is compared with the length of the file
before memory is allocated. trimesh has no such limits, and ignores fans, instances, sparse accessors, targets, bones
and required extensions.
"""

from __future__ import annotations

import base64
import binascii
import struct
from collections.abc import Callable, Container, Iterator
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import unquote_to_bytes, urlsplit

import numpy as np
from numpy.typing import NDArray

from niwaki.inputs.limits import beyond, check, limit
from niwaki.inputs.texts import json_of
from niwaki.targets import polygons
from niwaki.targets.pieces import Arrays, Unreadable

_MAGIC, _JSON, _BIN = 0x46546C67, 0x4E4F534A, 0x004E4942
_COLUMNS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_INDICES = (5121, 5123, 5125)
_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_HUGE = 1 << 40
#: The largest number of sets of four joints of a vertex.
_SETS = 4
_INSTANCES = "EXT_mesh_gpu_instancing"
#: Extensions that a file may require: those that this reader knows, and those that only change the look of surfaces.
_KNOWN = (_INSTANCES, "KHR_mesh_quantization")
_LOOKS = ("KHR_lights_", "KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_")


def parsed(data: bytes, suffix: str, beside: Callable[[str], bytes]) -> list[Arrays]:
    """Parse the bytes of a file into vertices and faces of its placed meshes, in the order of its nodes.

    Parameters
    ----------
    data
        The file.
    suffix
        ".glb" or ".gltf".
    beside
        Returns the bytes of a file that this file names.

    Raises
    ------
    Unreadable
        The file is no glTF 2.0, or uses something that is not supported.
    FileError
        The file is beyond a limit.
    """
    text, chunk = _chunks(data) if suffix == ".glb" else (data, b"")
    try:
        tree = _table(json_of(text.decode("utf-8-sig"), None, suffix), "the file")
    except UnicodeDecodeError as error:
        raise Unreadable(f"its JSON is no text: {error}") from error
    version = _table(tree.get("asset", {}), "`asset`").get("version", "2.0")
    if not str(version).startswith("2"):
        raise Unreadable(f"it is glTF {version!s:.20}; only version 2 is read")
    _check_required(tree)
    return _File(tree, chunk, beside).placed()


class _File:
    """The tables and buffers of a file."""

    def __init__(self, tree: dict[str, Any], chunk: bytes, beside: Callable[[str], bytes]) -> None:
        self.nodes, self.meshes, self.skins = (_tables(tree, name) for name in ("nodes", "meshes", "skins"))
        self.scenes, self.scene = _tables(tree, "scenes"), tree.get("scene", 0)
        self.accessors, self.views = _tables(tree, "accessors"), _tables(tree, "bufferViews")
        check("nodes", len(self.nodes), None)
        self.buffers = [
            _buffer(table, chunk if k == 0 else b"", beside)
            for k, table in enumerate(_tables(tree, "buffers"))
        ]

    def placed(self) -> list[Arrays]:
        """Return every mesh of every node."""
        meshes: list[Arrays] = []
        budget = 4 * sum(map(len, self.buffers)) + limit("copies")
        numbers = 0
        matrices = dict(self.walk())
        parts_of: dict[str, list[_Part]] = {}
        for number, matrix in matrices.items():
            node = self.nodes[number]
            if "mesh" not in node:
                continue
            mesh = _index(node["mesh"], self.meshes, "mesh")
            weights = node.get("weights", self.meshes[mesh].get("weights", []))
            key = f"{mesh} {weights}"
            if key not in parts_of:
                parts_of[key] = list(self.primitives(mesh, _list(weights, "`weights`")))
            if "skin" in node:
                skin = self.skins[_index(node["skin"], self.skins, "skin")]
                parts, places = [part.bent(self.bones(skin, matrices)) for part in parts_of[key]], [np.eye(4)]
            else:
                parts, places = parts_of[key], [matrix @ instance for instance in self.instances(node)]
            for place in places:
                for part in parts:
                    numbers += len(part.vertices) + part.faces.size
                    if numbers > budget:
                        raise beyond("copies", f"its {len(self.nodes):,} nodes place more", None)
                    if len(meshes) == limit("nodes"):
                        raise beyond("nodes", f"it places more than {len(meshes):,} meshes", None)
                    meshes.append(part.placed(place))
        return meshes

    def walk(self) -> Iterator[tuple[int, NDArray[np.float64]]]:
        """Yield the number and the matrix of each node in order, parents before their children."""
        if self.scenes:
            roots = _list(self.scenes[_index(self.scene, self.scenes, "scene")].get("nodes", []), "`nodes`")
        else:
            children = [
                child for node in self.nodes for child in _list(node.get("children", []), "`children`")
            ]
            below = {child for child in children if isinstance(child, int)}
            roots = [number for number in range(len(self.nodes)) if number not in below]
        stack = [(root, np.eye(4)) for root in reversed(roots)]
        visited: set[int] = set()
        while stack:
            entry, above = stack.pop()
            number = _index(entry, self.nodes, "node")
            if number in visited:
                raise Unreadable(f"node {number} has two parents, or is below itself")
            visited.add(number)
            node = self.nodes[number]
            with np.errstate(all="ignore"):
                matrix = above @ _matrix(node)
            stack += [(child, matrix) for child in reversed(_list(node.get("children", []), "`children`"))]
            yield number, matrix

    def instances(self, node: dict[str, Any]) -> NDArray[np.float64]:
        """Return the matrices of a mesh relative to its node, (n, 4, 4): the identity, or one for each instance."""
        extension = _table(node.get("extensions", {}), "`extensions`").get(_INSTANCES)
        if extension is None:
            return np.eye(4)[None]
        places = _table(
            _table(extension, f"`{_INSTANCES}`").get("attributes"), "`attributes` of its instances"
        )
        columns = {
            name: self.numbers(places[name], kind, _TYPES)
            for name, kind in (("TRANSLATION", "VEC3"), ("ROTATION", "VEC4"), ("SCALE", "VEC3"))
            if name in places
        }
        counts = sorted({len(column) for column in columns.values()})
        if len(counts) != 1:
            raise Unreadable(
                f"a node's instances have {counts} places, turns and scales, expected one number of each"
            )
        check("nodes", counts[0], None)
        rows = {name.lower(): column.tolist() for name, column in columns.items()}
        return np.array(
            [_matrix(dict(zip(rows, row, strict=True))) for row in zip(*rows.values(), strict=True)]
        ).reshape(-1, 4, 4)

    def bones(self, skin: dict[str, Any], matrices: dict[int, NDArray[np.float64]]) -> NDArray[np.float64]:
        """Return the matrices by which the joints of a skin move a vertex at rest, (n, 4, 4)."""
        joints = [_index(joint, self.nodes, "node") for joint in _list(skin.get("joints", []), "`joints`")]
        if missing := [joint for joint in joints if joint not in matrices]:
            raise Unreadable(f"the joint {missing[0]} of a skin is in no scene")
        poses = np.array([matrices[joint] for joint in joints]).reshape(-1, 4, 4)
        if "inverseBindMatrices" not in skin:
            return poses
        # Files store matrices column by column.
        rest = self.numbers(skin["inverseBindMatrices"], "MAT4", _TYPES).reshape(-1, 4, 4).transpose(0, 2, 1)
        if len(rest) < len(poses):
            raise Unreadable(f"a skin has {len(poses)} joints and {len(rest)} matrices")
        with np.errstate(all="ignore"):
            return np.asarray(poses @ rest[: len(poses)])

    def primitives(self, mesh: int, weights: list[Any]) -> Iterator[_Part]:
        """Yield the parts of a mesh that have triangles."""
        for primitive in _tables(self.meshes[mesh], "primitives"):
            mode = primitive.get("mode", _TRIANGLES)
            if mode not in (_TRIANGLES, _STRIP, _FAN):
                continue
            places = _table(primitive.get("attributes", {}), "`attributes`")
            if "POSITION" not in places:
                continue
            vertices = self.numbers(places["POSITION"], "VEC3", _TYPES).astype(np.float64)
            for weight, target in zip(weights, _tables(primitive, "targets"), strict=False):
                if weight and "POSITION" in target:
                    moved = self.numbers(target["POSITION"], "VEC3", _TYPES)
                    with np.errstate(all="ignore"):
                        vertices = vertices + _floats([weight], 1, "weights") * _as_many(moved, vertices)
            if "indices" in primitive:
                flat = self.numbers(primitive["indices"], "SCALAR", _INDICES).reshape(-1).astype(np.int64)
            else:
                flat = np.arange(len(vertices))
            part = _Part(vertices, _triangles(flat, mode))
            for k in range(_SETS):
                if f"JOINTS_{k}" in places and f"WEIGHTS_{k}" in places:
                    part.joints.append(
                        _as_many(self.numbers(places[f"JOINTS_{k}"], "VEC4", _INDICES), vertices)
                    )
                    part.weights.append(
                        _as_many(self.numbers(places[f"WEIGHTS_{k}"], "VEC4", _TYPES), vertices)
                    )
            yield part

    def numbers(self, entry: Any, kind: str, codes: Container[int]) -> NDArray[Any]:
        """Return the numbers of an accessor of a kind, (count, columns)."""
        accessor = self.accessors[_index(entry, self.accessors, "accessor")]
        code = accessor.get("componentType")
        if accessor.get("type") != kind or not isinstance(code, int) or code not in codes:
            shown = f"{accessor.get('type')!s:.20} {code!s:.20}"
            raise Unreadable(f"accessor {entry} has type {shown}, expected {kind}")
        shape = _whole(accessor.get("count"), "count"), _COLUMNS[kind]
        dtype = np.dtype(_TYPES[code])
        if "bufferView" in accessor:
            numbers = self.rows(accessor, shape, dtype, f"accessor {entry}")
        elif "sparse" in accessor:
            check("copies", shape[0], None)
            numbers = np.zeros(shape, dtype)
        else:
            raise Unreadable("its meshes are compressed (Draco); export them without compression")
        if "sparse" in accessor:
            numbers = numbers.copy()
            sparse = _table(accessor["sparse"], "`sparse`")
            count = _whole(sparse.get("count"), "count")
            indices, values = (
                _table(sparse.get(name), f"`{name}` of `sparse`") for name in ("indices", "values")
            )
            if indices.get("componentType") not in _INDICES:
                raise Unreadable(
                    f"the indices of a sparse accessor have type {indices.get('componentType')!s:.20}"
                )
            rows = self.rows(
                indices, (count, 1), np.dtype(_TYPES[indices["componentType"]]), "a sparse accessor"
            )[:, 0]
            if count and rows.max() >= len(numbers):
                raise Unreadable(f"a sparse accessor names row {rows.max():,} of {len(numbers):,}")
            numbers[rows] = self.rows(values, (count, shape[1]), dtype, "a sparse accessor")
        if dtype.kind != "f" and accessor.get("normalized") is True:
            return np.asarray(np.maximum(numbers / np.iinfo(dtype).max, -1.0))
        return numbers

    def rows(
        self, table: dict[str, Any], shape: tuple[int, int], dtype: np.dtype[Any], name: str
    ) -> NDArray[Any]:
        """Return rows of the view that a table names."""
        view = self.views[_index(table.get("bufferView"), self.views, "bufferView")]
        if any("meshopt" in name for name in _table(view.get("extensions", {}), "`extensions`")):
            raise Unreadable("its meshes are compressed (meshopt); export them without compression")
        buffer = self.buffers[_index(view.get("buffer"), self.buffers, "buffer")]
        count, columns = shape
        row = columns * dtype.itemsize
        start, length = (
            _whole(view.get("byteOffset", 0), "byteOffset"),
            _whole(view.get("byteLength"), "byteLength"),
        )
        offset = _whole(table.get("byteOffset", 0), "byteOffset")
        stride = _whole(view.get("byteStride", row), "byteStride")
        if start + length > len(buffer):
            raise Unreadable(f"a view ends at byte {start + length:,} of a buffer that has {len(buffer):,}")
        if count == 0:
            return np.empty((0, columns), dtype)
        if stride < row or offset + (count - 1) * stride + row > length:
            raise Unreadable(f"{name} names {count:,} rows, and its view has {length:,} bytes")
        return np.ndarray((count, columns), dtype, buffer, start + offset, (stride, dtype.itemsize))


@dataclass
class _Part:
    """A part of a mesh, with the joints of a skin that move its vertices and their weights, four in each set."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    joints: list[NDArray[Any]] = field(default_factory=list)
    weights: list[NDArray[Any]] = field(default_factory=list)

    def bent(self, bones: NDArray[np.float64]) -> _Part:
        """Return the part in the pose of its bones."""
        if not self.joints:
            return self
        whole = np.zeros((len(self.vertices), 3, 4))
        with np.errstate(all="ignore"):
            for joints, weights in zip(self.joints, self.weights, strict=True):
                for k in range(4):
                    # A weight of zero may name any joint.
                    used = np.where(weights[:, k] > 0, joints[:, k], 0).astype(np.int64)
                    if len(used) and used.max() >= len(bones):
                        raise Unreadable(f"a vertex names joint {used.max()} of {len(bones)}")
                    whole += weights[:, k, None, None] * bones[used, :3]
            vertices = np.einsum("vij,vj->vi", whole[:, :, :3], self.vertices) + whole[:, :, 3]
        return _Part(vertices, self.faces)

    def placed(self, matrix: NDArray[np.float64]) -> Arrays:
        """Return vertices and faces, moved by a matrix."""
        if np.array_equal(matrix, np.eye(4)):
            return self.vertices, self.faces
        with np.errstate(all="ignore"):
            vertices = self.vertices @ matrix[:3, :3].T + matrix[:3, 3]
            # A mirror image turns its triangles over.
            return vertices, self.faces[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0.0 else self.faces


def _as_many(rows: NDArray[Any], vertices: NDArray[Any]) -> NDArray[Any]:
    if len(rows) != len(vertices):
        raise Unreadable(f"a mesh has {len(vertices):,} vertices, and {len(rows):,} rows about them")
    return rows


def _check_required(tree: dict[str, Any]) -> None:
    """Refuse a file that requires an unknown extension."""
    for name in _list(tree.get("extensionsRequired", []), "`extensionsRequired`"):
        if not isinstance(name, str) or not (name in _KNOWN or name.startswith(_LOOKS)):
            reason = f"it requires the extension {name!a:.60}, which is not known"
            if "draco" in str(name) or "meshopt" in str(name):
                reason = f"its meshes are compressed ({name!a:.60}); export them without compression"
            raise Unreadable(reason)


def _chunks(data: bytes) -> tuple[bytes, bytes]:
    """Return the JSON of a .glb file, and its first binary chunk."""
    if len(data) < 20 or struct.unpack_from("<I", data)[0] != _MAGIC:
        raise Unreadable("it does not begin as a .glb file does")
    version, total = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise Unreadable(f"it is glTF {version}; only version 2 is read")
    if total > len(data):
        raise Unreadable(f"it should have {total:,} bytes and has {len(data):,}: it is cut short")
    at = 12
    chunks: dict[int, bytes] = {}
    while at + 8 <= total:
        length, kind = struct.unpack_from("<II", data, at)
        if at + 8 + length > total:
            raise Unreadable(f"a chunk of {length:,} bytes does not fit into the file")
        chunks.setdefault(kind, data[at + 8 : at + 8 + length])
        at += 8 + length
    if _JSON not in chunks:
        raise Unreadable("it has no JSON chunk")
    return chunks[_JSON], chunks.get(_BIN, b"")


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
    """Return the name of a file in or below the folder of the file that names it.

    Raises
    ------
    Unreadable
        The name is an address elsewhere.
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
    matrix = np.eye(4)
    matrix[:3, :3] = turn * _floats(node.get("scale", [1, 1, 1]), 3, "scale")
    matrix[:3, 3] = _floats(node.get("translation", [0, 0, 0]), 3, "translation")
    return matrix


def _triangles(flat: NDArray[np.int64], mode: int) -> NDArray[np.int64]:
    if mode == _STRIP:
        return polygons.strips(flat)
    if mode == _FAN:
        return polygons.fans(flat.reshape(1, -1)).reshape(-1, 3)
    if len(flat) % 3:
        raise Unreadable(f"{len(flat)} indices make no triangles")
    return flat.reshape(-1, 3)


def _table(value: Any, name: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise Unreadable(f"{name} is no table")
    return value


def _list(value: Any, name: str) -> list[Any]:
    if not isinstance(value, list):
        raise Unreadable(f"{name} is no list")
    return value


def _tables(tree: dict[str, Any], name: str) -> list[dict[str, Any]]:
    return [_table(entry, f"an entry of `{name}`") for entry in _list(tree.get(name, []), f"`{name}`")]


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
    if len(numbers) != count or not all(isinstance(number, (int, float)) for number in numbers):
        raise Unreadable(f"a node's `{name}` is not {count} numbers")
    return np.array(numbers, dtype=np.float64)
