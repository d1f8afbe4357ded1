"""Warnings that name the line of the user's code, however deep in the package their cause is."""

from __future__ import annotations

import sys
import warnings

_PACKAGE = __name__.partition(".")[0]


def warn(text: str, kind: type[Warning]) -> None:
    """Warn at the innermost line outside of the package."""
    depth, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals["__name__"].partition(".")[0] == _PACKAGE:
        depth, frame = depth + 1, frame.f_back
    warnings.warn(text, kind, stacklevel=depth)
