"""Differences between a result and its target, by cells or pixels, as the score counts them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import InputError
from niwaki.studio.messages import Answer, Difference, FindDifference
from niwaki.studio.worker import runs
from niwaki.targets.fit import cells

#: Values of a byte of the payload.
BOTH, MISSING, OUTSIDE = 1, 2, 3


def find(job: FindDifference, send: Any) -> Answer:
    """Send the cells or pixels of a result."""
    sample = runs.sample(job.source, job.number)
    header = Difference(job.id, job.key)
    grid = cells(sample.search.score, sample.scene)
    if grid is not None:
        marks = marked(grid.target, grid.scene)
        header.low, header.high = tuple(grid.low.tolist()), tuple(grid.high.tolist())
        header.size = marks.shape[0], marks.shape[1], marks.shape[2]
        # x runs fastest.
        payload = marks.T.tobytes()
    elif sample.search.score.views:
        view = sample.search.score.views[0]
        marks = marked(view.image, view.mask(sample.scene))
        rows, columns = marks.shape
        header.size, header.is_picture, payload = (columns, rows, 1), True, marks.tobytes()
        if view.window is not None:
            (x0, y0), (x1, y1) = view.window
            header.low, header.high = (x0, y0, 0.0), (x1, y1, 0.0)
    else:
        raise InputError("no-target", name="this result")
    send(header, payload)
    return Answer()


def marked(target: NDArray[np.bool_], scene: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Mark each cell with a byte."""
    return np.where(target, np.where(scene, BOTH, MISSING), np.where(scene, OUTSIDE, 0)).astype(np.uint8)
