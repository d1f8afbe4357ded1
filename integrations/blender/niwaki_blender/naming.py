"""Which files of models may be run: those that a person named since Blender was started.

A model is code. A .blend may name a file, in the panel or as the file of a result; it is run only after a person has
seen its name and the hash of its bytes, and has agreed. Nothing of this is stored.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

from niwaki.errors import NiwakiError
from niwaki.inputs import bytes_of

_named: set[Path] = set()


class Unnamed(Exception):
    """A file that nobody named since Blender was started.

    Attributes
    ----------
    path
        The file.
    """

    def __init__(self, path: Path, reason: str = "") -> None:
        self.path = path
        text = reason or "this .blend names it, and a model is code. Read the file, then press Trust"
        super().__init__(f"{path} is not run: {text}")


def digest(path: Path) -> str:
    """SHA-256 of the bytes of a file, in hexadecimal; empty where it cannot be read."""
    try:
        return hashlib.sha256(bytes_of(path, "model")).hexdigest()
    except (OSError, NiwakiError):
        return ""


def name(path: Path) -> None:
    """A person has chosen this file."""
    _named.add(path.resolve())


def trust(path: Path, sha256: str) -> None:
    """A person has agreed that the file with these bytes is run.

    Raises
    ------
    Unnamed
        The file has other bytes, or cannot be read.
    """
    found = digest(path)
    if not found:
        raise Unnamed(path, "it cannot be read")
    if found != sha256:
        raise Unnamed(path, f"its SHA-256 is {found[:12]}..., and {sha256[:12]}... was agreed to")
    name(path)


def named(path: Path) -> bool:
    """Whether the file may be run."""
    return path.resolve() in _named


def words() -> tuple[str, ...]:
    """The named files, as a worker's command line has them."""
    return tuple(sorted(str(path) for path in _named))


def check(path: Path) -> None:
    """Refuse a file that nobody named.

    Raises
    ------
    Unnamed
        It may not be run.
    """
    if not named(path):
        raise Unnamed(path)


def forget() -> None:
    """Start afresh, as Blender does."""
    _named.clear()
