"""A folder of results: run.json, and files that show one of its runs.

A run.json never stands beside a file of another run, whenever the process ends:

1. what the run.json that is there names is removed, where it is as it was written;
2. run.json is replaced;
3. the files are written;
4. run.json is written again, with their hashes.

Each step leaves whole files, and files that are missing can be written again by `niwaki replay`. Only one run at a
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
from niwaki.shell import pictures, run_files, writing

RUN = "run.json"

#: Files that commands write beside run.json, but for those with a number.
KNOWN = {
    *(f"best.{name}" for name in (*writing.FORMATS, "png")),
    *(f"growth.{name}" for name in writing.ANIMATIONS),
    *(f"{name}.png" for name in ("sheet", "image", "shadow", "drawing")),
    "samples.csv",
}

#: Files by which a folder of `niwaki color` or `niwaki letters` is known; they have no run.json.
OTHERS = {"colors.json", "residuals.csv", "word.png", "word.svg"}

#: Those that show one run; the others show the search.
OF_ONE_RUN = {name for name in KNOWN if name.startswith(("best.", "growth."))}

#: Files of a run by its number: `run-3.glb`, `run-3.png`.
_NUMBERED = re.compile(rf"run-[1-9][0-9]*\.({'|'.join((*writing.FORMATS, 'png'))})")
#: Files of a colouring by its number: `01.svg`, `01.png`.
_COLORED = re.compile(r"[0-9]{2,}\.(svg|png)")


def is_known(name: str) -> bool:
    """Whether commands write files of this name beside run.json: these alone are ever removed."""
    return name in KNOWN or _NUMBERED.fullmatch(name) is not None


def present(folder: Path) -> list[Path]:
    """The results that are in a folder, run.json first."""
    if not os.path.isdir(folder):
        return []
    there = [
        place
        for place in folder.iterdir()
        if place.name in {RUN, *OTHERS} or is_known(place.name) or _COLORED.fullmatch(place.name)
    ]
    return sorted(there, key=lambda place: (place.name != RUN, place.name))


@contextmanager
def written(folder: Path, data: dict[str, Any], names: Iterable[str]) -> Iterator[None]:
    """Write a folder of results; inside, the files are written.

    Parameters
    ----------
    folder
        Where, held for this run (`held_folder`).
    data
        What becomes run.json.
    names
        The files that will be written beside it, which `is_known`.
    """
    names = tuple(names)
    former = _former(folder)
    listed: dict[str, str | None] = {
        name: one for name, one in former.get("files", {}).items() if is_known(name)
    }
    same = _same_search(former, data)
    if same:
        shown = former.get("shown") == data.get("shown")
        gone = {} if shown else {name: one for name, one in listed.items() if name in OF_ONE_RUN}
    else:
        gone = listed | dict.fromkeys(names)
    files = {name: one for name, one in listed.items() if same and name not in gone} | dict.fromkeys(names)
    # On the disk before anything is removed: where there is no room the folder stays as it was.
    with written_beside(folder / RUN, _json({**data, "files": files})) as take_place:
        for name, digest in gone.items():
            _remove(folder / name, name in names or (digest is None and name in OF_ONE_RUN), digest)
        take_place()
    try:
        yield
    finally:
        # Also where a file failed or Ctrl-C came: what is there belongs to this run.
        write_whole(folder / RUN, _json({**data, "files": _hashed(folder, files)}))


def is_of(folder: Path, data: dict[str, Any]) -> bool:
    """Whether a folder has the results of the search of a run.json."""
    return _same_search(_former(folder), data)


def write_one(
    place: Path, data: dict[str, Any], sample: Sample, files: writing.Files, drawn: pictures.Pictures
) -> Path:
    """Write one file that shows a run, by its suffix: its picture, what becomes run.json, or another format."""
    kind = place.suffix[1:].lower()
    if kind == "json":
        return write_whole(place, _json(data))
    return drawn.best(sample, place, files.style) if kind == "png" else files.write_one(sample, place)


def _json(data: dict[str, Any]) -> bytes:
    return (json.dumps(data, indent=1, allow_nan=False) + "\n").encode()


def _former(folder: Path) -> dict[str, Any]:
    """The run.json that is there; nothing where there is none that can be read."""
    try:
        found = run_files.load(folder / RUN)
    except NiwakiError:
        return {}
    return {"files": {}, **found}


def _same_search(former: dict[str, Any], data: dict[str, Any]) -> bool:
    """Whether two run.json have the same runs of the same search."""
    return bool(former) and all(former.get(name) == data.get(name) for name in ("hash", "runs", "best"))


def _remove(place: Path, surely: bool, digest: str | None) -> None:
    """Remove a file of a former run, surely or only where it is as it was written."""
    try:
        if place.is_file() and (surely or _digest(place) == digest):
            place.unlink()
    except OSError as error:
        raise unwritable(place, error) from error


def _hashed(folder: Path, files: dict[str, str | None]) -> dict[str, str | None]:
    """The files that are there, with their hashes."""
    return {
        name: one or _digest(folder / name)
        for name, one in sorted(files.items())
        if is_known(name) and (folder / name).is_file()
    }


def _digest(place: Path) -> str:
    with unreadable(place):
        return hashlib.sha256(place.read_bytes()).hexdigest()
