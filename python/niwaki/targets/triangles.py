"""The triangles of OBJ, STL and PLY files, as the library trimesh reads them."""

from __future__ import annotations

import io
import logging
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from niwaki.errors import FileError
from niwaki.inputs.guard import library
from niwaki.targets.pieces import joined


def arrays(data: bytes, suffix: str) -> dict[str, NDArray[Any]]:
    """Vertices (n, 3) float64 and faces (m, 3) int64 of all objects of a file.

    Raises
    ------
    FileError
        It cannot be read, or holds no triangles.
    """
    data = _in_one(data, suffix)
    with library(None, suffix), warnings.catch_warnings(), _silent():
        warnings.simplefilter("ignore")
        # NumPy warns where it stops in the middle of a list of numbers.
        warnings.filterwarnings("error", message="string or file could not be read")
        kind = suffix.removeprefix(".")
        # Without materials: they are other files, and images.
        options: dict[str, Any] = {} if suffix == ".stl" else {"skip_materials": True}
        loaded = trimesh.load_scene(io.BytesIO(data), file_type=kind, process=False, **options)
        shapes = [part for part in loaded.dump() if isinstance(part, trimesh.Trimesh)]
        parts = [(np.asarray(one.vertices, np.float64), np.asarray(one.faces, np.int64)) for one in shapes]
        empty = not loaded.geometry
    if not any(len(faces) for _, faces in parts):
        found = "the file holds no object" if empty else "the file holds points or curves only"
        raise FileError("target-empty", None, reason=found)
    vertices, faces = joined(parts, suffix)
    return {"vertices": vertices, "faces": faces}


def _in_one(data: bytes, suffix: str) -> bytes:
    """A text without its divisions: all parts become one mesh, and the time of trimesh grows with their square."""
    if suffix == ".obj":
        return re.sub(rb"(?m)^[ \t]*usemtl\b[^\n]*", b"", data)
    if suffix == ".stl" and data[:512].lstrip()[:5].lower() == b"solid" and b"endsolid" in data.lower():
        facets = re.sub(rb"(?mi)^[ \t]*(?:end)?solid\b[^\n]*", b"", data)
        # A binary file may begin with the same word; its facets are no text.
        return b"solid\n" + facets + b"\nendsolid\n" if b"vertex" in facets.lower() else data
    return data


@contextmanager
def _silent() -> Iterator[None]:
    """Without what trimesh logs: errors of a file are ours to tell."""
    log, silence = logging.getLogger("trimesh"), logging.NullHandler()
    before, log.propagate = log.propagate, False
    log.addHandler(silence)
    try:
        yield
    finally:
        log.propagate = before
        log.removeHandler(silence)
