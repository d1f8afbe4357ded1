"""Meshes from OBJ, STL, PLY, GLB and glTF files: all objects of a file together, each placed as its file places it.

The counts in the head of a file are compared with its length first. A separate process (`niwaki.inputs.child`) reads a
large file whose reader has no limits.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from niwaki.errors import FileError
from niwaki.inputs import bytes_of, limit, read_apart, regular
from niwaki.targets import gltf, obj, ply, stl
from niwaki.targets.memory import BYTES_PER_BYTE, check_memory
from niwaki.targets.pieces import Arrays, Unreadable, joined

FORMATS = (".obj", ".stl", ".ply", ".glb", ".gltf")

#: Memory of a process that reads a mesh, for each byte of the file: twice what the worst format takes.
APART_PER_BYTE = 40

_READERS = {".obj": obj.parsed, ".stl": stl.parsed, ".ply": ply.parsed}


def load(path: str | PathLike[str]) -> Arrays:
    """Read vertices and faces of a mesh file.

    Raises
    ------
    FileError
        The file is missing, empty, larger than the limit, or of another format.
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
    """Parse the bytes of a mesh file into vertices and faces.

    Parameters
    ----------
    data
        The file.
    suffix
        One of `FORMATS`.
    place
        The path of the file; without it, no other file is read.

    Raises
    ------
    FileError
        `file-unreadable`, `file-limit` or `target-empty`.
    """
    if not data:
        raise FileError("file-unreadable", place, suffix=suffix, reason="the file holds no bytes")
    try:
        if suffix in (".glb", ".gltf"):
            return _gltf(data, suffix, place)
        # The head of binary STL determines its length.
        plain = suffix == ".stl" and not stl.is_text(data)
        if suffix == ".ply":
            ply.check_head(data)
    except Unreadable as reason:
        raise FileError("file-unreadable", place, suffix=suffix, reason=str(reason)) from None
    if plain or len(data) <= limit("apart"):
        mesh = arrays(data, suffix)
    else:
        memory = limit("memory") + APART_PER_BYTE * len(data)
        mesh = read_apart(arrays, data, place, suffix, memory, suffix=suffix)
    return mesh["vertices"], mesh["faces"]


def arrays(data: bytes, suffix: str) -> dict[str, NDArray[Any]]:
    """Parse an OBJ, STL or PLY file into vertices (n, 3) float64 and faces (m, 3) int64.

    Raises
    ------
    FileError
        The file cannot be read, or holds no triangles.
    """
    try:
        vertices, faces = _READERS[suffix](data)
    except Unreadable as reason:
        raise FileError("file-unreadable", None, suffix=suffix, reason=str(reason)) from None
    if not len(faces):
        raise FileError("target-empty", None, reason="none of its faces has three corners")
    return {"vertices": vertices, "faces": faces}


def _gltf(data: bytes, suffix: str, place: Path | None) -> Arrays:
    def beside(uri: str) -> bytes:
        name = gltf.name_of(uri)
        if place is None:
            raise Unreadable(f"it names {name!a:.80}, another file; write one .glb file")
        return bytes_of(place.parent / name, "mesh")

    parts = gltf.parsed(data, suffix, beside)
    if not any(len(faces) for _, faces in parts):
        reason = "the file holds points or curves only" if parts else "the file holds no object"
        raise FileError("target-empty", place, reason=reason)
    return joined(parts)
