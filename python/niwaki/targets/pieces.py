"""What the readers of meshes share: why a file is no mesh, and its objects as one mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Arrays = tuple[NDArray[np.float64], NDArray[np.int64]]


class Unreadable(Exception):
    """Why a file is no mesh that can be read."""


def joined(parts: list[Arrays]) -> Arrays:
    """All parts as one; refused where a face names a vertex that its part does not have."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    for vertices, faces in parts:
        check_corners(faces, len(vertices))
    return (
        np.concatenate([vertices for vertices, _ in parts]),
        np.concatenate([faces + start for (_, faces), start in zip(parts, starts, strict=False)]),
    )


def check_corners(corners: NDArray[np.int64], count: int) -> None:
    """Refuse a corner that is none of `count` vertices, numbered from 0."""
    wrong = corners[(corners < 0) | (corners >= count)]
    if len(wrong):
        raise Unreadable(f"a face names vertex {wrong[0]}, and there are {count}, counted from 0")
