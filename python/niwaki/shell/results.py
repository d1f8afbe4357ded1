"""A folder of results: run.json, and files that show its runs.

A run.json never stands beside a file of another run, whenever the process ends:

1. the files that the earlier run.json names are removed, unless someone has changed them;
2. run.json is replaced;
3. the files are written;
4. run.json is written again, with their hashes.

Each step leaves whole files, and `niwaki replay` can write the missing files again. Only one run at a
time writes (`niwaki.errors.folders`).
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from niwaki.errors import NiwakiError
from niwaki.errors.files import unreadable, unwritable, write_whole, written_beside
from niwaki.result import Sample
from niwaki.shell import formats, pictures, run_files

RUN = "run.json"

#: Files without a number that commands write beside run.json.
KNOWN = {
    *(f"best.{name}" for name in (*formats.FORMATS, "png")),
    *(f"growth.{name}" for name in formats.ANIMATIONS),
    *(f"{name}.png" for name in ("sheet", "image", "shadow", "drawing")),
    "samples.csv",
}

#: Files that mark a folder of `niwaki color` or `niwaki letters`, which has no run.json.
WITHOUT_RUN = {"colors.json", "residuals.csv", "word.png", "word.svg"}

#: Files that show one run; the other files show the search.
OF_ONE_RUN = {name for name in KNOWN if name.startswith(("best.", "growth."))}

#: Files of a run by its number: `run-3.glb`, `run-3.png`.
_NUMBERED = re.compile(rf"run-[1-9][0-9]*\.({'|'.join((*formats.FORMATS, 'png'))})")
#: Files of a colouring by its number: `01.svg`, `01.png`.
_COLORED = re.compile(r"[0-9]{2,}\.(svg|png)")


def is_known(name: str) -> bool:
    """Return whether commands write files of this name beside run.json; only such files are ever removed."""
    return name in KNOWN or _NUMBERED.fullmatch(name) is not None


def present(folder: Path) -> list[Path]:
    """Return the results in a folder, run.json first."""
    if not os.path.isdir(folder):
        return []
    files = [
        place
        for place in folder.iterdir()
        if place.name in {RUN, *WITHOUT_RUN} or is_known(place.name) or _COLORED.fullmatch(place.name)
    ]
    return sorted(files, key=lambda place: (place.name != RUN, place.name))


@contextmanager
def results_folder(folder: Path, data: dict[str, Any], names: Iterable[str]) -> Iterator[None]:
    """Write run.json into a folder; inside the context the caller writes the other files.

    Parameters
    ----------
    folder
        The folder, locked for this run (`held_folder`).
    data
        The data of run.json.
    names
        Names of the other files; `is_known` is true for each of them.
    """
    names = tuple(names)
    former = _former(folder)
    listed: dict[str, str | None] = {
        name: digest for name, digest in former.get("files", {}).items() if is_known(name)
    }
    same_search = _same_search(former, data)
    if same_search:
        shown = former.get("shown") == data.get("shown")
        obsolete = {} if shown else {name: digest for name, digest in listed.items() if name in OF_ONE_RUN}
    else:
        obsolete = listed | dict.fromkeys(names)
    valid = {name: digest for name, digest in listed.items() if same_search and name not in obsolete}
    files = valid | dict.fromkeys(names)
    # run.json is on the disk before any file is removed: without room the folder stays as it was.
    with written_beside(folder / RUN, _json({**data, "files": files})) as take_place:
        for name, digest in obsolete.items():
            _remove(folder / name, name in names or (digest is None and name in OF_ONE_RUN), digest)
        take_place()
    try:
        yield
    finally:
        # After an error or Ctrl-C, too: the files that exist belong to this run.
        write_whole(folder / RUN, _json({**data, "files": _hashed(folder, files)}))


def is_of(folder: Path, data: dict[str, Any]) -> bool:
    """Return whether a folder has results of the search in `data`."""
    return _same_search(_former(folder), data)


def write_one(
    place: Path, data: dict[str, Any], sample: Sample, files: formats.Files, images: pictures.Pictures
) -> Path:
    """Write one file of a run: its picture, run.json, or another format, as the suffix tells."""
    kind = place.suffix[1:].lower()
    if kind == "json":
        return write_whole(place, _json(data))
    return images.best(sample, place, files.style) if kind == "png" else files.write_one(sample, place)


def _json(data: dict[str, Any]) -> bytes:
    return (json.dumps(data, indent=1, allow_nan=False) + "\n").encode()


def _former(folder: Path) -> dict[str, Any]:
    """Return the data of the earlier run.json; an empty table if none can be read."""
    try:
        data = run_files.load(folder / RUN)
    except NiwakiError:
        return {}
    return {"files": {}, **data}


def _same_search(former: dict[str, Any], data: dict[str, Any]) -> bool:
    """Return whether two run.json have the same runs of the same search."""
    return bool(former) and all(former.get(name) == data.get(name) for name in ("hash", "runs", "best"))


def _remove(place: Path, surely: bool, digest: str | None) -> None:
    """Remove a file of an earlier run: always if `surely` is set, else only if it has this digest."""
    try:
        if place.is_file() and (surely or _digest(place) == digest):
            place.unlink()
    except OSError as error:
        raise unwritable(place, error) from error


def _hashed(folder: Path, files: dict[str, str | None]) -> dict[str, str | None]:
    """Return the files that exist, with their hashes."""
    return {
        name: digest or _digest(folder / name)
        for name, digest in sorted(files.items())
        if is_known(name) and (folder / name).is_file()
    }


def _digest(place: Path) -> str:
    with unreadable(place):
        return hashlib.sha256(place.read_bytes()).hexdigest()
