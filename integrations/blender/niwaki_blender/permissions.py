"""Permissions of model files: files that a person named since the start of Blender may run.

A model is code. A .blend may name a file, in the panel or as the file of a result. Such a file runs only after a person
has seen its name and the hash of its bytes, and has agreed. Permissions are not stored.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

from niwaki.errors import NiwakiError
from niwaki.inputs import bytes_of

_named: set[Path] = set()


class UntrustedFileError(Exception):
    """A file that no person has named since the start of Blender.

    Attributes
    ----------
    path
        The file.
    """

    def __init__(self, path: Path, reason: str = "") -> None:
        self.path = path
        text = reason or "only this .blend names it, and a model is code. Read the file, then press Trust"
        super().__init__(f"{path} was not run: {text}")


def digest(path: Path) -> str:
    """Return the SHA-256 of a file in hexadecimal; empty if the file cannot be read."""
    try:
        return hashlib.sha256(bytes_of(path, "model")).hexdigest()
    except (OSError, NiwakiError):
        return ""


def name(path: Path) -> None:
    """Allow a file that a person has chosen."""
    _named.add(path.resolve())


def trust(path: Path, sha256: str) -> None:
    """Allow a file after a person has agreed to its bytes.

    Raises
    ------
    UntrustedFileError
        The file has other bytes, or cannot be read.
    """
    present = digest(path)
    if not present:
        raise UntrustedFileError(path, "it cannot be read")
    if present != sha256:
        raise UntrustedFileError(
            path, f"its SHA-256 is {present[:12]}..., but you agreed to {sha256[:12]}..."
        )
    name(path)


def is_allowed(path: Path) -> bool:
    """Whether the file may be run."""
    return path.resolve() in _named


def words() -> tuple[str, ...]:
    """Return the allowed files as words of a worker's command line."""
    return tuple(sorted(str(path) for path in _named))


def check(path: Path) -> None:
    """Check that a file may be run.

    Raises
    ------
    UntrustedFileError
        The file may not be run.
    """
    if not is_allowed(path):
        raise UntrustedFileError(path)


def forget() -> None:
    """Remove all permissions, as a restart of Blender does."""
    _named.clear()
