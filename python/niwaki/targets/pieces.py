"""The objects of a file as one mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import FileError


def joined(
    parts: list[tuple[NDArray[np.float64], NDArray[np.int64]]], suffix: str
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """All parts as one; refused where a face names a vertex that its part does not have."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    for vertices, faces in parts:
        if vertices.shape[1:] != (3,) or faces.shape[1:] != (3,):
            reason = f"its rows have {vertices.shape[-1]} coordinates and {faces.shape[-1]} corners, expected 3 and 3"
            raise FileError("file-unreadable", None, suffix=suffix, reason=reason)
        if len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
            wrong = int(faces.min() if faces.min() < 0 else faces.max())
            reason = f"a face names vertex {wrong + 1} of {len(vertices)}"
            raise FileError("file-unreadable", None, suffix=suffix, reason=reason)
    return (
        np.concatenate([vertices for vertices, _ in parts]),
        np.concatenate([faces + start for (_, faces), start in zip(parts, starts, strict=False)]),
    )
