"""Where a result differs from what is wanted, cell by cell or pixel by pixel, as the score counts them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import InputError
from niwaki.studio.messages import Answer, Difference, FindDifference
from niwaki.studio.worker import runs
from niwaki.targets.fit import cells

#: What a byte of the payload says.
BOTH, MISSING, OUTSIDE = 1, 2, 3


def find(job: FindDifference, send: Any) -> Answer:
    """The cells or pixels of a result."""
    one = runs.sample(job.source, job.number)
    header = Difference(job.id, job.key)
    found = cells(one.search.score, one.scene)
    if found is not None:
        marks = marked(found.target, found.scene)
        header.low, header.high = tuple(found.low.tolist()), tuple(found.high.tolist())
        header.size = marks.shape[0], marks.shape[1], marks.shape[2]
        # x runs fastest.
        payload = marks.T.tobytes()
    elif one.search.score.views:
        view = one.search.score.views[0]
        marks = marked(view.image, view.mask(one.scene))
        rows, columns = marks.shape
        header.size, header.is_picture, payload = (columns, rows, 1), True, marks.tobytes()
        if view.window is not None:
            (x0, y0), (x1, y1) = view.window
            header.low, header.high = (x0, y0, 0.0), (x1, y1, 0.0)
    else:
        raise InputError("no-target", name="this result")
    send(header, payload)
    return Answer()


def marked(wanted: NDArray[np.bool_], made: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """A byte for each."""
    return np.where(wanted, np.where(made, BOTH, MISSING), np.where(made, OUTSIDE, 0)).astype(np.uint8)
