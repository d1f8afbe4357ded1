"""Meshes from OBJ, STL, PLY and GLB files: all objects of a file together, each placed as its file places it."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from niwaki.errors import FileError
from niwaki.errors.files import existing
from niwaki.targets.memory import BYTES_PER_BYTE, check_memory

FORMATS = (".obj", ".stl", ".ply", ".glb", ".gltf")


def load(path: str | PathLike[str]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices and faces of a mesh file.

    Raises
    ------
    FileError
        The file is missing, empty, or of a format that is not read.
    InputError
        `mesh-too-large`: there is not enough memory.
    """
    place = existing(path)
    suffix = place.suffix.lower()
    if suffix not in FORMATS:
        raise FileError(
            "file-format",
            path,
            suffix=place.suffix or "no suffix",
            done="read",
            formats=", ".join(FORMATS),
        )
    size = place.stat().st_size
    if size == 0:
        raise FileError("file-unreadable", path, suffix=suffix, reason="the file holds no bytes")
    check_memory(str(path), f"{size / 1e6:,.0f} MB on disk", size * BYTES_PER_BYTE)
    return _read(place, suffix)


def _read(place: Path, suffix: str) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices and faces of all objects of a file, each placed as its file places it."""
    options: dict[str, Any] = {"skip_materials": True} if suffix == ".obj" else {}
    try:
        loaded = trimesh.load_scene(place, process=False, **options)
        parts = [part for part in loaded.dump() if isinstance(part, trimesh.Trimesh)]
        arrays = [(np.asarray(part.vertices, np.float64), np.asarray(part.faces, np.int64)) for part in parts]
    except Exception as error:  # readers of meshes raise errors of any type
        reason = " ".join(str(error).split()) or type(error).__name__
        raise FileError("file-unreadable", place, suffix=suffix, reason=reason) from error
    if not any(len(faces) for _, faces in arrays):
        found = "the file holds points or curves only" if loaded.geometry else "the file holds no object"
        raise FileError("target-empty", place, reason=found)
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in arrays)])
    for vertices, faces in arrays:
        if len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
            reason = f"a face names vertex {int(faces.max()) + 1} of {len(vertices)}"
            raise FileError("file-unreadable", place, suffix=suffix, reason=reason)
    return (
        np.concatenate([vertices for vertices, _ in arrays]),
        np.concatenate([faces + start for (_, faces), start in zip(arrays, starts, strict=False)]),
    )
