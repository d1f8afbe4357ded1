"""Common parts of the mesh readers: the error for a file that is no mesh, and objects joined into one mesh."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Arrays = tuple[NDArray[np.float64], NDArray[np.int64]]


class Unreadable(Exception):
    """A file that is no readable mesh. The text is the reason."""


def joined(parts: Sequence[Arrays]) -> Arrays:
    """Join all parts into one mesh, empty without parts. Refuse a face that names a vertex outside of its part."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    for vertices, faces in parts:
        check_corners(faces, len(vertices))
    return (
        np.concatenate([np.zeros((0, 3)), *(vertices for vertices, _ in parts)]),
        np.concatenate(
            [
                np.zeros((0, 3), np.int64),
                *(faces + start for (_, faces), start in zip(parts, starts, strict=False)),
            ]
        ),
    )


def check_corners(corners: NDArray[np.int64], count: int) -> None:
    """Refuse a corner that is none of `count` vertices, numbered from 0."""
    outside = corners[(corners < 0) | (corners >= count)]
    if len(outside):
        raise Unreadable(f"a face names vertex {outside[0]}, and there are {count}, counted from 0")
