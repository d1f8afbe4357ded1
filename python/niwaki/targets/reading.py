"""Meshes from OBJ, STL, PLY, GLB and glTF files: all objects of a file together, each placed as its file places it.

What a file announces is held against its length first. A large file whose reader keeps no limits is read in a process
of its own (`niwaki.inputs.child`).
"""

from __future__ import annotations

import struct
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from niwaki import targets
from niwaki.errors import FileError
from niwaki.inputs import bytes_of, limit, read_apart, regular
from niwaki.targets import gltf
from niwaki.targets.memory import BYTES_PER_BYTE, check_memory
from niwaki.targets.pieces import joined

FORMATS = (".obj", ".stl", ".ply", ".glb", ".gltf")

#: Memory of a process that reads a mesh, for each byte of the file: twice what the worst format takes.
APART_PER_BYTE = 40

_STL_HEAD, _STL_TRIANGLE = 84, 50
_PLY_SIZES = {
    **dict.fromkeys(("char", "uchar", "int8", "uint8"), 1),
    **dict.fromkeys(("short", "ushort", "int16", "uint16", "float16"), 2),
    **dict.fromkeys(("int", "uint", "int32", "uint32", "float", "float32"), 4),
    **dict.fromkeys(("int64", "uint64", "double", "float64"), 8),
}

Arrays = tuple[NDArray[np.float64], NDArray[np.int64]]


def load(path: str | PathLike[str]) -> Arrays:
    """Vertices and faces of a mesh file.

    Raises
    ------
    FileError
        The file is missing, empty, larger than is read, or of a format that is not read.
    InputError
        `mesh-too-large`: there is not enough memory.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        shown = Path(path).suffix or "no suffix"
        raise FileError("file-format", path, suffix=shown, done="read", formats=", ".join(FORMATS))
    size = regular(path).stat().st_size
    check_memory(str(path), f"{size / 1e6:,.0f} MB on disk", size * BYTES_PER_BYTE)
    data = bytes_of(path, "mesh")
    try:
        return parsed(data, suffix, Path(path))
    except FileError as error:
        error.place = path if error.place is None else error.place
        raise


def parsed(data: bytes, suffix: str, place: Path | None = None) -> Arrays:
    """Vertices and faces of the bytes of a mesh file.

    Parameters
    ----------
    data
        The file.
    suffix
        One of `FORMATS`.
    place
        Where it is; without it, no file beside it is read.

    Raises
    ------
    FileError
        `file-unreadable`, `file-limit` or `target-empty`.
    """
    if not data:
        raise FileError("file-unreadable", place, suffix=suffix, reason="the file holds no bytes")
    if suffix in (".glb", ".gltf"):
        return _gltf(data, suffix, place)
    plain = False
    try:
        if suffix == ".stl":
            plain = _check_stl(data)
        elif suffix == ".ply":
            _check_ply(data)
    except _Unreadable as reason:
        raise FileError("file-unreadable", place, suffix=suffix, reason=str(reason)) from None
    if plain or len(data) <= limit("apart"):
        found = targets.triangles.arrays(data, suffix)
    else:
        memory = limit("memory") + APART_PER_BYTE * len(data)
        found = read_apart(targets.triangles.arrays, data, place, suffix, memory, suffix=suffix)
    return found["vertices"], found["faces"]


class _Unreadable(Exception):
    """Why a file is no mesh."""


def _gltf(data: bytes, suffix: str, place: Path | None) -> Arrays:
    def beside(uri: str) -> bytes:
        name = gltf.name_of(uri)
        if place is None:
            raise gltf.Unreadable(f"it names {name!a:.80}, another file; write one .glb file")
        return bytes_of(place.parent / name, "mesh")

    try:
        parts = gltf.parsed(data, suffix, beside)
    except gltf.Unreadable as reason:
        raise FileError("file-unreadable", place, suffix=suffix, reason=str(reason)) from reason
    if not any(len(faces) for _, faces in parts):
        found = "the file holds points or curves only" if parts else "the file holds no object"
        raise FileError("target-empty", place, reason=found)
    return joined(parts, suffix)


def _check_stl(data: bytes) -> bool:
    """Whether it is binary; refused where it is neither that nor text."""
    if len(data) >= _STL_HEAD:
        (count,) = struct.unpack_from("<I", data, _STL_HEAD - 4)
        if len(data) == _STL_HEAD + count * _STL_TRIANGLE:
            return True
    if data[:512].lstrip()[:5].lower() == b"solid" and b"facet" in data[:65536].lower():
        return False
    if len(data) < _STL_HEAD:
        raise _Unreadable(f"it has {len(data)} bytes, fewer than the head of an STL file")
    raise _Unreadable(
        f"its head announces {count:,} triangles, {count * _STL_TRIANGLE:,} bytes, "
        f"and {len(data) - _STL_HEAD:,} bytes follow"
    )


def _check_ply(data: bytes) -> None:
    """Refuse a file that is too short for what its head announces."""
    end = data.find(b"end_header", 0, 1 << 16)
    if not data[:3].lower() == b"ply" or end < 0:
        raise _Unreadable("it has no head of a PLY file")
    left = len(data) - end
    is_text = b"ascii" in data[:64].lower()
    needed, names, count, row = 0, set(), 0, 0
    for line in [*data[:end].decode("latin-1").splitlines(), "element - 0"]:
        words = line.split()
        if len(words) == 3 and words[0] == "element":
            if count and not row:
                raise _Unreadable("its head announces rows without properties")
            needed += count * row
            if words[1] in names:
                raise _Unreadable(f"its head announces `{words[1]:.40}` twice")
            names.add(words[1])
            if not words[2].isdecimal() or len(words[2]) > 18:
                raise _Unreadable(f"its head announces {words[2]:.40} rows")
            count, row = int(words[2]), 0
        elif len(words) >= 3 and words[0] == "property":
            # At least: a list's own length; in text, a digit and a space.
            kind = words[2] if words[1] == "list" else words[1]
            if kind not in _PLY_SIZES:
                raise _Unreadable(f"its head has a property of type `{kind:.40}`")
            row += 2 if is_text else _PLY_SIZES[kind]
    if needed > left:
        raise _Unreadable(f"its head announces at least {needed:,} bytes, and {left:,} follow")
