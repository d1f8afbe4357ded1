"""Libraries that only some users of the package install."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from niwaki.errors.files import FileError


def optional(module: str, task: str, extra: str) -> Any:
    """Import a library of an extra of the package, or raise an error that names the extra and the `task`."""
    try:
        return import_module(module)
    except ImportError:
        raise FileError("missing-extra", task=task, extra=extra) from None
