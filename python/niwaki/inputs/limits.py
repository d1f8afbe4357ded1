"""Limits for the reading of users' files.

`NIWAKI_LIMITS=4` in the environment multiplies the limits by 4, except limits of depth: deeper files would end the
process.
"""

from __future__ import annotations

import os
from dataclasses import dataclass

from niwaki.errors import FileError, InputError

#: The environment's variable that multiplies the limits.
VARIABLE = "NIWAKI_LIMITS"
MB = 1_000_000


@dataclass(frozen=True)
class Limit:
    """A limit.

    Attributes
    ----------
    most : int
        The largest allowed count.
    unit : str
        The unit of the count, for messages.
    reason : str
        The reason for this number.
    fixed : bool
        Whether the environment cannot raise it.
    """

    most: int
    unit: str
    reason: str
    fixed: bool = False


LIMITS = {
    # Files.
    "mesh": Limit(2_000 * MB, "bytes", "a scan of 40 million triangles in STL"),
    "image": Limit(256 * MB, "bytes", "16 million pixels of 16 bits and four channels, not compressed"),
    "drawing": Limit(16 * MB, "bytes", "drawings with 256 regions are far smaller"),
    "outline": Limit(16 * MB, "bytes", "100,000 corners with all their digits"),
    "rules": Limit(1 * MB, "bytes", "rules about 256 regions take 20 kB"),
    "camera": Limit(1 * MB, "bytes", "a camera takes 200 bytes"),
    "guide": Limit(256 * MB, "bytes", "the largest guide of the package takes 0.4 MB"),
    "checkpoint": Limit(2_000 * MB, "bytes", "a training of a million traces of twenty choices"),
    "batch": Limit(2_000 * MB, "bytes", "a thousand cases, each with a mesh of 40,000 triangles"),
    "run": Limit(256 * MB, "bytes", "a thousand runs of ten thousand choices"),
    "session": Limit(1 * MB, "bytes", "a session's name takes 50"),
    "journal": Limit(1_000 * MB, "bytes", "fifty thousand steps, each with a gallery of fifty results"),
    "preset": Limit(1 * MB, "bytes", "a model has tens of arguments"),
    "model": Limit(16 * MB, "bytes", "a program that a person writes takes some kB"),
    "font": Limit(64 * MB, "bytes", "the largest common fonts, of Chinese, take 20 MB"),
    # Contents of files.
    "pixels": Limit(1 << 24, "pixels", "4,096 by 4,096; a search works with far fewer"),
    "scans": Limit(100, "scans", "a progressive JPEG has about ten, and each takes as long as a whole image"),
    "copies": Limit(2 * MB, "triangles by copies", "many nodes of a glTF file may place the same mesh"),
    "nodes": Limit(100_000, "nodes", "a city, house by house"),
    "tokens": Limit(4 * MB, "values", "JSON takes up to 100 times its size once it is read"),
    "elements": Limit(20_000, "elements", "a map of a town"),
    "characters": Limit(32 * MB, "characters once each `use` is replaced", "twice the largest file"),
    "spaces": Limit(64, "namespaces", "drawing programs declare about ten"),
    "styles": Limit(2 * MB, "comparisons of shapes and selectors", "2 seconds"),
    "corners": Limit(10_000, "corners", "each edge is compared with each; a room has tens"),
    "comparisons": Limit(
        64 * MB,
        "comparisons of corners",
        "2 seconds; cutting a concave polygon may compare each corner with each",
    ),
    "dots": Limit(64, "dots of a key in a line", "the time of TOML's reader grows with their square"),
    "rule-regions": Limit(4_000, "regions named by rules", "256 regions, each in 15 rules"),
    # Depth.
    "depth": Limit(
        200, "levels", "drawings have about ten; readers that call themselves end the process", True
    ),
    # Reading in a separate process.
    "apart": Limit(1 * MB, "bytes", "smaller files are read at once: what is wrong in them costs little"),
    "seconds": Limit(60, "seconds", "a mesh of 10 million triangles in the slowest format"),
    "memory": Limit(1_000 * MB, "bytes of memory", "the libraries take 300 MB of it; a large file gets more"),
}


def limit(name: str) -> int:
    """Return a limit, multiplied by the environment's factor.

    Raises
    ------
    InputError
        `bad-setting`: the variable is not a number from 1 to 1000.
    """
    known = LIMITS[name]
    return known.most if known.fixed else int(known.most * _factor())


def check(name: str, count: float, place: str | os.PathLike[str] | None) -> None:
    """Refuse a file whose contents exceed a limit.

    Raises
    ------
    FileError
        `file-limit`, with the count.
    """
    most = limit(name)
    if count > most:
        raise beyond(name, f"it has {count:,} {LIMITS[name].unit}", place)


def beyond(name: str, reason: str, place: str | os.PathLike[str] | None) -> FileError:
    """Return the error about a file that exceeds a limit."""
    known = LIMITS[name]
    cure = f"if you trust the file, set {VARIABLE}=4 in the environment, which multiplies the limits by 4"
    return FileError(
        "file-limit",
        place,
        found=reason,
        most=f"{limit(name):,} {known.unit}",
        cure="use a file with less nesting" if known.fixed else f"use a smaller file; {cure}",
    )


def _factor() -> float:
    text = os.environ.get(VARIABLE, "1")
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not 1.0 <= factor <= 1000.0:
        raise InputError(
            "bad-setting",
            name=VARIABLE,
            found=repr(text),
            expected="a number from 1 to 1000",
            suggestion="4, or leave it out",
        )
    return factor
